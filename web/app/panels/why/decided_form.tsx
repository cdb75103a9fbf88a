import { useState } from 'react';
import type { Deciding } from '../../../core/deciding';
import { useDrives, useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { decidedWords as words } from './decided_words';

const kTries = [10, 20, 50, 100];
const kUsual = 20;

/** The condition, and how often the run is continued; Stop while it is looked for. */
export function DecidedForm({ deciding }: { deciding: Deciding }) {
  const studio = useStudio();
  const drives = useDrives();
  const [condition, setCondition] = useState(deciding.condition ?? '');
  const [tries, setTries] = useState(deciding.tries ?? kUsual);
  const runs = deciding.state === 'running';
  const send = (what: Promise<unknown>) =>
    void what.catch((problem: unknown) => studio.tell(problem));
  return (
    <form
      className="decided__form"
      aria-label={words.form}
      onSubmit={(event) => {
        event.preventDefault();
        if (!runs) send(studio.send('turning.ask', { condition, tries }));
      }}
    >
      <label className="decided__condition">
        {words.condition}
        <input
          className="field field--small grow"
          data-autofocus
          placeholder={words.example}
          spellCheck={false}
          autoComplete="off"
          value={condition}
          onChange={(event) => setCondition(event.target.value)}
        />
      </label>
      <label data-tip={words.triesHelp}>
        {words.tries}
        <select
          className="field field--small field--ui"
          value={tries}
          onChange={(event) => setTries(Number(event.target.value))}
        >
          {kTries.map((one) => (
            <option key={one}>{one}</option>
          ))}
        </select>
      </label>
      {runs ? (
        <Button small disabled={!drives} onClick={() => send(studio.send('turning.stop', {}))}>
          {words.stop}
        </Button>
      ) : (
        <Button small type="submit" disabled={!drives || condition.trim() === ''}>
          {words.ask}
        </Button>
      )}
    </form>
  );
}
