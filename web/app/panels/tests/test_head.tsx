import { IconPlayerPlay, IconPlayerStop } from '@tabler/icons-react';
import { testOptionsOf, type Tests } from '../../../core/tests';
import { runTests, stopTests } from '../../commands/test_acts';
import { useChanges, useDrives, useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { testWords as words } from '../../views/tests/words';

const size = { size: 14, stroke: kStroke };

/** Run all, stop, how far it is; said once when it begins, and once when it ends. */
export function TestHead({ tests }: { tests: Tests }) {
  const studio = useStudio();
  const drives = useDrives();
  const options = testOptionsOf(studio);
  useChanges(options.changed);
  const { state, runs, done } = tests;
  const act = (what: Promise<void>) => void what.catch((problem: unknown) => studio.tell(problem));
  return (
    <header className="tests__head">
      {state === 'running' ? (
        <Button
          small
          disabled={!drives}
          icon={<IconPlayerStop {...size} />}
          onClick={() => act(stopTests(studio))}
        >
          {words.stop}
        </Button>
      ) : (
        <Button
          small
          disabled={!drives}
          tip={words.runAllHelp}
          icon={<IconPlayerPlay {...size} />}
          onClick={() => act(runTests(studio, null))}
        >
          {words.runAll}
        </Button>
      )}
      {state === 'running' ? (
        <>
          <progress
            className="tests__progress"
            aria-label={words.progress}
            max={runs}
            value={done}
          />
          <span className="num muted">{words.of(done, runs)}</span>
        </>
      ) : null}
      <p className="tests__said" role="status">
        {saidOf(tests)}
      </p>
      <span className="grow" />
      <button
        type="button"
        role="switch"
        className="switch"
        aria-checked={options.scripts}
        data-tip={words.scriptsHelp}
        disabled={!drives}
        onClick={() => options.toggle('scripts')}
      >
        {words.scripts}
      </button>
    </header>
  );
}

function saidOf({ state, why, runs, done, failed, changed }: Tests): string {
  switch (state) {
    case 'none':
      return '';
    case 'running':
      return runs === 0 ? '' : words.running(runs);
    case 'done':
      return [words.done(done, failed), changed.length > 0 ? words.changed : ''].join(' ').trim();
    case 'stopped':
      return words.stopped(done, runs);
    case 'failed':
      return words.failed(why ?? '');
  }
}
