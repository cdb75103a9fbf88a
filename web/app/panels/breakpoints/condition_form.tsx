import { useState } from 'react';
import { mistakeIn } from '../../../core/condition';
import { kindOf } from '../../documents';
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
  const [tried, setTried] = useState('');
  const wrong = mistakeIn(condition);
  const told = tried === condition ? wrong : '';
  const doc = looked !== null && kindOf(looked) === 'plan' ? looked : own;
  if (doc === undefined) return null;
  const add = () => {
    setTried(condition);
    if (condition.trim() === '' || wrong) return;
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
          aria-invalid={told !== ''}
          spellCheck={false}
          disabled={!drives}
          onChange={(event) => setCondition(event.target.value)}
        />
      </label>
      {told ? (
        <p className="planform__why" role="alert">
          {told}
        </p>
      ) : null}
      <Button small type="submit" disabled={!drives || condition.trim() === ''}>
        {words.add}
      </Button>
    </form>
  );
}
