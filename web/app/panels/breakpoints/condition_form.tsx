import { useState } from 'react';
import { mistakeIn } from '../../../core/condition';
import { kindOf } from '../../documents';
import { useDrives, useStudio, useTopic, useWindow } from '../../hooks';
import { Button } from '../../parts/button';
import { whyOf } from '../../../core/why';
import { breakWords as words } from './words';

/** A plan that stops when a condition becomes true: the one that is looked at, else the project's. */
export function ConditionForm() {
  const studio = useStudio();
  const drives = useDrives();
  const looked = useWindow((state) => state.doc);
  const own = useTopic('studio', {})?.project?.plan;
  const [condition, setCondition] = useState('');
  const [tried, setTried] = useState('');
  const [refused, setRefused] = useState('');
  const wrong = mistakeIn(condition);
  const told = tried === condition ? wrong || refused : '';
  const doc = looked !== null && kindOf(looked) === 'plan' ? looked : own;
  if (doc === undefined) return null;
  const add = async () => {
    setTried(condition);
    setRefused('');
    if (condition.trim() === '' || wrong) return;
    const wanted = { doc, kind: 'condition', condition: condition.trim() } as const;
    try {
      await studio.send('plan.break.set', wanted);
      setCondition('');
    } catch (problem) {
      // A variable that the plan does not have: what was typed stays.
      setRefused(whyOf(problem));
    }
  };
  return (
    <form className="bp__when" onSubmit={(event) => (event.preventDefault(), void add())}>
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
