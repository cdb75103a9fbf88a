import type { EditorView } from '@codemirror/view';
import { IconListCheck, IconPlayerPlay, IconPlayerStop } from '@tabler/icons-react';
import { useMemo } from 'react';
import { failedPlaces, isAsRun, stateOf, type Tests } from '../../../core/tests';
import { revealPanel } from '../../../core/window_state';
import type { Doc } from '../../../protocol/messages';
import { runTests, stopTests } from '../../commands/test_acts';
import { useDrives, useStudio, useTopic } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { failureMarks, type FailureMark } from './failure_marks';
import { useMarks } from './use_marks';
import { testWords as words } from './words';

const size = { size: 14, stroke: kStroke };

/** Runs the test; its lines are marked where they were not as expected, as long as they are as run. */
export function TestBar({ doc, view }: { doc: Doc; view: EditorView | null }) {
  const studio = useStudio();
  const drives = useDrives();
  const tests = useTopic('tests', {});
  const test = tests?.tests.find(({ path }) => path === doc);
  const isRunning = tests?.state === 'running';
  // One that is disabled meanwhile would lose the keyboard.
  const mayRun = drives && !isRunning;
  const marks = useMemo(() => marksOf(tests, doc), [tests, doc]);
  useMarks(view, failureMarks, marks);
  const act = (what: Promise<void>) => void what.catch((problem: unknown) => studio.tell(problem));
  return (
    <div className="tests__bar" role="group" aria-label={words.bar}>
      <Button
        small
        keys={words.keys}
        aria-disabled={!mayRun}
        tip={isRunning ? words.busy : words.runHelp}
        icon={<IconPlayerPlay {...size} />}
        onClick={() => mayRun && act(runTests(studio, [doc]))}
      >
        {words.run}
      </Button>
      {isRunning ? (
        <Button
          small
          kind="plain"
          disabled={!drives}
          icon={<IconPlayerStop {...size} />}
          onClick={() => act(stopTests(studio))}
        >
          {words.stop}
        </Button>
      ) : null}
      <span className="grow" />
      {test && tests ? (
        <>
          <span className={`tests__state is-${stateOf(test, tests)}`}>
            {words.states[stateOf(test, tests)]}
          </span>
          <span className="num muted">{words.of(test.done - test.failed, test.runs)}</span>
        </>
      ) : null}
      <Button
        small
        kind="plain"
        icon={<IconListCheck {...size} />}
        onClick={() => revealPanel(studio.window, 'tests')}
      >
        {words.results}
      </Button>
    </div>
  );
}

/** As long as the test is as it was run. */
function marksOf(tests: Tests | undefined, doc: Doc): FailureMark[] {
  const failures = tests?.tests.find(({ path }) => path === doc)?.failures ?? [];
  if (!isAsRun(tests, doc)) return [];
  return failedPlaces(failures).map(({ at, count, first }) => ({
    line: at.line,
    text: words.place(count, first),
  }));
}
