import { useState } from 'react';
import { tidy } from '../../../core/world/snap';
import { text } from '../../text';
import { Field } from './fields';

/** A number typed exactly; arrows step; empty is what the format takes then. */
export function NumberField(props: {
  label: string;
  unit?: string;
  value: number | undefined;
  otherwise?: string;
  low?: number;
  high?: number;
  step?: number;
  whole?: boolean;
  disabled?: boolean;
  onSet: (value: number | undefined) => void;
}) {
  const { label, unit, value, otherwise, step = 0.01, whole, disabled, onSet } = props;
  const { low = -1e6, high = 1e6 } = props;
  const shown = value === undefined ? '' : String(tidy(value));
  const [draft, setDraft] = useState<string | null>(null);
  const number = Number((draft ?? '').replace(',', '.'));
  const empty = draft !== null && draft.trim() === '';
  const good =
    draft === null ||
    (empty
      ? otherwise !== undefined
      : Number.isFinite(number) && number >= low && number <= high && !(whole && number % 1));
  const done = () => {
    if (draft !== null && good && draft !== shown) onSet(empty ? undefined : number);
    setDraft(null);
  };
  const by = (sign: number) => {
    const next = tidy(Math.min(high, Math.max(low, (value ?? 0) + sign * step)));
    setDraft(null);
    onSet(next);
  };
  return (
    <Field label={label} {...(unit ? { unit } : {})}>
      {(id) => (
        <input
          id={id}
          className="field field--small num"
          inputMode="decimal"
          autoComplete="off"
          value={draft ?? shown}
          placeholder={otherwise ?? ''}
          disabled={disabled}
          aria-invalid={!good}
          title={good ? undefined : text.world.badNumber(low, high)}
          onChange={(event) => setDraft(event.target.value)}
          onBlur={done}
          onKeyDown={(event) => {
            if (event.key === 'Enter') done();
            else if (event.key === 'Escape') setDraft(null);
            else if (event.key === 'ArrowUp') by(event.shiftKey ? 10 : 1);
            else if (event.key === 'ArrowDown') by(event.shiftKey ? -10 : -1);
            else return;
            event.preventDefault();
            event.stopPropagation();
          }}
        />
      )}
    </Field>
  );
}
