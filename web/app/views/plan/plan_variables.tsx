import { useState } from 'react';
import type { PlanVariable } from '../../../protocol/messages';
import { typedValue, valueOf } from '../../../core/plan_view';
import { useStudio } from '../../hooks';
import { useMayAct } from '../../past_hooks';
import { text } from '../../text';

const words = text.plan;

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
  const [draft, setDraft] = useState<string | null>(null);
  const typed = draft === null ? undefined : typedValue(type, draft);
  const set = (to: typeof value) => studio.order('plan.set', { level, name, value: to });
  const done = () => {
    if (draft !== null && typed !== undefined && draft !== valueOf(value)) set(typed);
    setDraft(null);
  };
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
          value={draft ?? valueOf(value)}
          readOnly={!drives || type === 'object'}
          aria-invalid={draft !== null && typed === undefined}
          onChange={(event) => setDraft(event.target.value)}
          onBlur={done}
          onKeyDown={(event) => {
            if (event.key === 'Enter') done();
            else if (event.key === 'Escape') setDraft(null);
          }}
        />
      )}
      <span className="prop__unit">{unit}</span>
    </li>
  );
}
