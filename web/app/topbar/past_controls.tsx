import {
  IconArrowBarToRight,
  IconPlayerPlay,
  IconPlayerTrackNext,
  IconPlayerTrackPrev,
} from '@tabler/icons-react';
import { useDrives, usePart, useStudio } from '../hooks';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { useTraceName } from '../past_hooks';
import { text } from '../text';
import { pastWords as words } from './past_words';

const size = { size: 16, stroke: kStroke };

/** While a person looks back, run and pause give way to steps in time. */
export default function PastControls() {
  const { registry } = useStudio();
  const trace = useTraceName();
  const drives = useDrives();
  const simulated = usePart('history', {}, (is) => is?.kind === 'simulated');
  const run = (id: string) => () => void registry.run(id);
  return (
    <>
      <Button
        className="btn--past"
        icon={<IconArrowBarToRight {...size} />}
        onClick={run('past.back')}
      >
        {trace === null ? words.back : words.close}
      </Button>
      {trace === null && simulated ? (
        <Button
          kind="primary"
          tip={words.continueTip}
          keys="F5"
          disabled={!drives}
          icon={<IconPlayerPlay {...size} />}
          onClick={run('past.continue')}
        >
          {text.commands['past.continue']}
        </Button>
      ) : null}
      <Button
        tip={words.stepBefore}
        keys="Shift+ArrowLeft"
        icon={<IconPlayerTrackPrev {...size} />}
        onClick={run('past.stepBefore')}
      />
      <Button
        tip={words.stepAfter}
        keys="Shift+ArrowRight"
        icon={<IconPlayerTrackNext {...size} />}
        onClick={run('past.stepAfter')}
      />
    </>
  );
}
