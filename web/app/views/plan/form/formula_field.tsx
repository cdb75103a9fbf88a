import { useId, useState } from 'react';
import type { PlanInput } from '../../../../protocol/messages';
import { shownFormula } from '../../../../core/plan/edit';
import { Field } from '../../world/fields';
import { text } from '../../../text';

/** One input: its formula; what counts without one stands there in grey. */
export function FormulaField(props: {
  input: PlanInput;
  value: string;
  variables: readonly string[];
  disabled: boolean;
  onSet: (typed: string) => void;
}) {
  const { input, value, variables, disabled, onSet } = props;
  const list = useId();
  const [draft, setDraft] = useState<string | null>(null);
  const done = () => {
    if (draft !== null && draft !== value) onSet(draft);
    setDraft(null);
  };
  const otherwise = input.default === undefined ? '' : shownFormula(input.default);
  return (
    <Field label={input.name} unit={input.unit}>
      {(id) => (
        <>
          <input
            id={id}
            className={value === '' ? 'field field--small is-default' : 'field field--small'}
            title={input.help}
            list={list}
            autoComplete="off"
            spellCheck={false}
            value={draft ?? value}
            placeholder={otherwise === '' ? text.draw.unfed : text.draw.default(otherwise)}
            aria-invalid={value === '' && input.default === undefined && draft === null}
            disabled={disabled}
            onChange={(event) => setDraft(event.target.value)}
            onBlur={done}
            onKeyDown={(event) => {
              if (event.key === 'Enter') done();
              else if (event.key === 'Escape') setDraft(null);
            }}
          />
          <datalist id={list}>
            {variables.map((name) => (
              <option key={name} value={name} />
            ))}
          </datalist>
        </>
      )}
    </Field>
  );
}
