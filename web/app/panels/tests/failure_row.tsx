import { IconHistory, IconPlayerPlay } from '@tabler/icons-react';
import type { Path, TestFailure } from '../../../protocol/messages';
import { openFailure, runByHand, showExpectation } from '../../commands/test_acts';
import { useDrives, useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { testWords as words } from '../../views/tests/words';

const size = { size: 14, stroke: kStroke };

/** What was not as expected in one run: its line, its recording at that instant, the same run live. */
export function FailureRow({ path, failure }: { path: Path; failure: TestFailure }) {
  const studio = useStudio();
  const drives = useDrives();
  const { seed, t, at, recording } = failure;
  const act = (what: Promise<void>) => void what.catch((problem: unknown) => studio.tell(problem));
  const disabled = !drives || recording === undefined;
  return (
    <li data-row className="tests__failure">
      <button
        type="button"
        className="tests__open"
        data-inset
        onClick={() => showExpectation(studio, path, failure)}
      >
        <span className="tests__seed num">{words.seed(seed)}</span>
        <span className="tests__at num">{t === undefined ? words.crashed : words.at(t)}</span>
        <span className="tests__what">{words.failure(failure)}</span>
        {at ? <span className="tests__place num">{`:${at.line}`}</span> : null}
      </button>
      <Button
        small
        kind="plain"
        disabled={disabled}
        tip={recording === undefined ? words.noRecording : words.openHelp}
        icon={<IconHistory {...size} />}
        onClick={() => act(openFailure(studio, failure))}
      >
        {words.open}
      </Button>
      <Button
        small
        kind="plain"
        disabled={disabled}
        tip={recording === undefined ? words.noRecording : words.byHandHelp}
        icon={<IconPlayerPlay {...size} />}
        onClick={() => act(runByHand(studio, failure))}
      >
        {words.byHand}
      </Button>
    </li>
  );
}
