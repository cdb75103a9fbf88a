import type { Json, PlanVariable } from '../../../protocol/messages';
import { typedValue, valueOf } from '../../../core/plan_view';
import { useChanges, useStudio } from '../../hooks';
import { useMayAct, usePastTime } from '../../past_hooks';
import { useDraft } from '../../parts/use_draft';
import { planWords } from './live_words';

const words = planWords;

/** Variables of a running plan, changed in place (P29); of an instant of the past for a run from there. */
export function PlanVariables(props: {
  level: number;
  path: string;
  variables: readonly PlanVariable[];
}) {
  const { level, path, variables } = props;
  return (
    <section className="planlive__part" aria-label={words.variables}>
      <h3>{words.variables}</h3>
      {variables.length === 0 ? <p className="quiet">{words.noVariables}</p> : null}
      <ul>
        {variables.map((variable) => (
          <Variable key={variable.name} level={level} path={path} variable={variable} />
        ))}
      </ul>
    </section>
  );
}

function Variable(props: { level: number; path: string; variable: PlanVariable }) {
  const { level, path, variable } = props;
  const studio = useStudio();
  const { settings } = studio.past;
  const past = usePastTime();
  const acts = useMayAct();
  const maySet = past === null ? acts : studio.registry.isEnabled('past.continue');
  const { name, type, unit } = variable;
  useChanges(settings.changed);
  const value = settings.get(path, name) ?? variable.value;
  const set = (to: Json) => {
    if (past === null) return studio.order('plan.set', { level, name, value: to });
    settings.set(path, name, to === variable.value ? undefined : to);
  };
  const draft = useDraft(valueOf(value), (given) => {
    const typed = typedValue(type, given);
    if (typed !== undefined) set(typed);
    return typed !== undefined;
  });
  return (
    <li className={settings.get(path, name) === undefined ? 'planvar' : 'planvar is-set'}>
      <code className="ellipsis">{name}</code>
      {type === 'bool' ? (
        <button
          type="button"
          role="switch"
          className="switch"
          aria-checked={value === true}
          aria-label={words.set(name)}
          disabled={!maySet}
          onClick={() => set(value !== true)}
        />
      ) : (
        <input
          className="field field--small num"
          aria-label={words.set(name)}
          autoComplete="off"
          value={draft.shown}
          readOnly={!maySet || type === 'object'}
          aria-invalid={draft.typed !== null && typedValue(type, draft.typed) === undefined}
          onChange={(event) => draft.set(event.target.value)}
          onBlur={draft.done}
          onKeyDown={draft.key}
        />
      )}
      <span className="prop__unit">{unit}</span>
    </li>
  );
}
