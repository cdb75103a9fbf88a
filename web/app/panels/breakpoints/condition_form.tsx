import { useState } from 'react';
import { kindOf } from '../../dock/documents';
import { useDrives, useStudio, useTopic, useWindow } from '../../hooks';
import { Button } from '../../parts/button';
import { text } from '../../text';

const words = text.breakpoints;

/** A plan that stops when a condition becomes true: the one that is looked at, else the project's. */
export function ConditionForm() {
  const studio = useStudio();
  const drives = useDrives();
  const looked = useWindow((state) => state.doc);
  const own = useTopic('studio', {})?.project?.plan;
  const [condition, setCondition] = useState('');
  const doc = looked !== null && kindOf(looked) === 'plan' ? looked : own;
  if (doc === undefined) return null;
  const add = () => {
    if (condition.trim() === '') return;
    studio.order('plan.break.set', { doc, kind: 'condition', condition: condition.trim() });
    setCondition('');
  };
  return (
    <form className="bp__when" onSubmit={(event) => (event.preventDefault(), add())}>
      <label>
        {words.when}
        <input
          className="field field--small"
          placeholder={words.whenHint}
          value={condition}
          spellCheck={false}
          disabled={!drives}
          onChange={(event) => setCondition(event.target.value)}
        />
      </label>
      <Button small type="submit" disabled={!drives || condition.trim() === ''}>
        {words.add}
      </Button>
    </form>
  );
}
