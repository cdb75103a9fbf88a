import { useState } from 'react';
import { readWords } from '../../../core/numbers';
import { useStudio } from '../../hooks';
import { text } from '../../text';
import type { Place } from './live_value';

const words = text.variables;

/** The value of a variable in its place: a number, or the words of an array from its first on. */
export function ValueEditor({ place, onEnd }: { place: Place; onEnd(): void }) {
  const studio = useStudio();
  const { node, variable, first, count } = place;
  const [typed, setTyped] = useState(() =>
    Array.from({ length: count }, (_, index) => studio.words.value(node, first + index) ?? 0).join(
      ' ',
    ),
  );
  const values = readWords(typed);
  const good = values !== null && values.length > 0 && values.length <= count;
  const save = () => {
    if (!good) return;
    const from = first - variable.address;
    studio.order('variable.set', { node, name: variable.name, first: from, values });
    onEnd();
  };
  return (
    <input
      className={count > 1 ? 'field value__field value__field--list' : 'field value__field'}
      autoFocus
      aria-label={words.valueOf(variable.name)}
      aria-invalid={!good}
      title={good ? undefined : count > 1 ? words.badValues(count) : words.badValue}
      value={typed}
      spellCheck={false}
      onFocus={(event) => event.target.select()}
      onChange={(event) => setTyped(event.target.value)}
      onBlur={onEnd}
      onKeyDown={(event) => {
        if (event.key === 'Enter') save();
        else if (event.key !== 'Escape') return;
        else onEnd();
        event.stopPropagation();
        event.preventDefault();
      }}
    />
  );
}
