import { useId, type ReactNode } from 'react';
import { useDraft } from '../../parts/use_draft';

export function Field({
  label,
  unit,
  children,
}: {
  label: string;
  unit?: string;
  children: (id: string) => ReactNode;
}) {
  const id = useId();
  return (
    <div className="prop">
      <label htmlFor={id} className="prop__label ellipsis">
        {label}
      </label>
      <span className="prop__value">{children(id)}</span>
      <span className="prop__unit">{unit}</span>
    </div>
  );
}

export function TextField(props: {
  label: string;
  value: string;
  otherwise?: string;
  disabled?: boolean;
  /** False: not now, it stays in the field. */
  onSet: (value: string) => boolean | void;
}) {
  const { label, value, otherwise, disabled, onSet } = props;
  const draft = useDraft(value, onSet);
  return (
    <Field label={label}>
      {(id) => (
        <input
          id={id}
          className="field field--small"
          autoComplete="off"
          spellCheck={false}
          value={draft.shown}
          placeholder={otherwise ?? ''}
          disabled={disabled}
          aria-invalid={draft.isRefused}
          onChange={(event) => draft.set(event.target.value)}
          onBlur={draft.done}
          onKeyDown={draft.key}
        />
      )}
    </Field>
  );
}

export function ChoiceField<T extends string>(props: {
  label: string;
  value: T;
  choices: readonly { value: T; label: string }[];
  disabled?: boolean;
  onSet: (value: T) => void;
}) {
  const { label, value, choices, disabled, onSet } = props;
  const known = choices.some((one) => one.value === value);
  return (
    <Field label={label}>
      {(id) => (
        <select
          id={id}
          className="field field--small field--ui"
          value={value}
          disabled={disabled}
          onChange={(event) => {
            const chosen = choices.find((one) => one.value === event.target.value);
            if (chosen) onSet(chosen.value);
          }}
        >
          {known ? null : <option value={value}>{value}</option>}
          {choices.map((one) => (
            <option key={one.value} value={one.value}>
              {one.label}
            </option>
          ))}
        </select>
      )}
    </Field>
  );
}

export function SwitchField(props: {
  label: string;
  on: boolean;
  disabled?: boolean;
  onSet: (on: boolean) => void;
}) {
  const { label, on, disabled, onSet } = props;
  return (
    <Field label={label}>
      {(id) => (
        <button
          id={id}
          type="button"
          role="switch"
          className="switch"
          aria-checked={on}
          aria-label={label}
          disabled={disabled}
          onClick={() => onSet(!on)}
        />
      )}
    </Field>
  );
}
