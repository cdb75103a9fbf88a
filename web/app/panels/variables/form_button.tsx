import { numberForms, type NumberForm } from '../../../core/numbers';
import { Button } from '../../parts/button';
import { text } from '../../text';

const words = text.variables;

/** Decimal, hexadecimal, binary: one after the other. */
export function FormButton({
  form,
  onChange,
}: {
  form: NumberForm;
  onChange(form: NumberForm): void;
}) {
  const next = numberForms[(numberForms.indexOf(form) + 1) % numberForms.length] ?? 'decimal';
  return (
    <Button
      kind="plain"
      small
      className="form-button"
      tip={words.form(words.forms[form])}
      aria-label={`${words.shortForms[form]}: ${words.form(words.forms[form])}`}
      onClick={() => onChange(next)}
    >
      {words.shortForms[form]}
    </Button>
  );
}
