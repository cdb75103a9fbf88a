import type { PlanVariable } from '../../../protocol/messages';
import { typedValue, valueOf } from '../../../core/plan_view';
import { useStudio } from '../../hooks';
import { useMayAct } from '../../past_hooks';
import { useDraft } from '../../parts/use_draft';
import { planWords } from './live_words';

const words = planWords;

/** Variables of a running plan, changed in place (P29). */
export function PlanVariables(props: { level: number; variables: readonly PlanVariable[] }) {
  const { level, variables } = props;
  return (
    <section className="planlive__part" aria-label={words.variables}>
      <h3>{words.variables}</h3>
      {variables.length === 0 ? <p className="quiet">{words.noVariables}</p> : null}
      <ul>
        {variables.map((variable) => (
          <Variable key={variable.name} level={level} variable={variable} />
        ))}
      </ul>
    </section>
  );
}

function Variable({ level, variable }: { level: number; variable: PlanVariable }) {
  const studio = useStudio();
  const drives = useMayAct();
  const { name, type, value, unit } = variable;
  const set = (to: typeof value) => studio.order('plan.set', { level, name, value: to });
  const draft = useDraft(valueOf(value), (given) => {
    const typed = typedValue(type, given);
    if (typed !== undefined) set(typed);
    return typed !== undefined;
  });
  return (
    <li className="planvar">
      <code className="ellipsis">{name}</code>
      {type === 'bool' ? (
        <button
          type="button"
          role="switch"
          className="switch"
          aria-checked={value === true}
          aria-label={words.set(name)}
          disabled={!drives}
          onClick={() => set(value !== true)}
        />
      ) : (
        <input
          className="field field--small num"
          aria-label={words.set(name)}
          autoComplete="off"
          value={draft.shown}
          readOnly={!drives || type === 'object'}
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
