import { tidy } from '../../../core/world/snap';
import { useDraft } from '../../parts/use_draft';
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
  /** False: not now, it stays in the field. */
  onSet: (value: number | undefined) => boolean | void;
}) {
  const { label, unit, value, otherwise, step = 0.01, whole, disabled, onSet } = props;
  const { low = -1e6, high = 1e6 } = props;
  const shown = value === undefined ? '' : String(tidy(value));
  const read = (typed: string) => {
    const number = Number(typed.replace(',', '.'));
    const isEmpty = typed.trim() === '';
    const isGood = isEmpty
      ? otherwise !== undefined
      : Number.isFinite(number) && number >= low && number <= high && !(whole && number % 1);
    return { isGood, number: isEmpty ? undefined : number };
  };
  const draft = useDraft(shown, (typed) => {
    const { isGood, number } = read(typed);
    return isGood && onSet(number) !== false;
  });
  const good = !draft.isRefused && (draft.typed === null || read(draft.typed).isGood);
  const by = (sign: number) => {
    const next = tidy(Math.min(high, Math.max(low, (value ?? 0) + sign * step)));
    if (onSet(next) !== false) draft.set(null);
  };
  return (
    <Field label={label} {...(unit ? { unit } : {})}>
      {(id) => (
        <input
          id={id}
          className="field field--small num"
          inputMode="decimal"
          autoComplete="off"
          value={draft.shown}
          placeholder={otherwise ?? ''}
          disabled={disabled}
          aria-invalid={!good}
          title={good ? undefined : text.world.badNumber(low, high)}
          onChange={(event) => draft.set(event.target.value)}
          onBlur={draft.done}
          onKeyDown={(event) => {
            if (event.key === 'ArrowUp') by(event.shiftKey ? 10 : 1);
            else if (event.key === 'ArrowDown') by(event.shiftKey ? -10 : -1);
            else if (!draft.key(event)) return;
            event.preventDefault();
            event.stopPropagation();
          }}
        />
      )}
    </Field>
  );
}
