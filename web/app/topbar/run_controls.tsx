import {
  IconPlayerPause,
  IconPlayerPlay,
  IconPlayerSkipForward,
  IconPlayerStop,
} from '@tabler/icons-react';
import { runStateOf } from '../../core/run_state';
import { useDrives, usePart, useStudio, useTopic } from '../hooks';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { late } from '../parts/late';
import { usePastTime } from '../past_hooks';
import { text } from '../text';

const size = { size: 16, stroke: kStroke };
const PastControls = late(() => import('./past_controls'), 'button');

/** Stop is first, always there, and always works. */
export function RunControls() {
  const { registry } = useStudio();
  const drives = useDrives();
  const clock = usePart('clock', {}, (is) => is?.state);
  const state = runStateOf(useTopic('robot', {}), clock && { state: clock }, useTopic('plan', {}));
  const paused = state === 'held';
  const runs = state === 'running';
  const looksBack = usePastTime() !== null;
  const run = (id: string) => () => void registry.run(id);
  const stop = (
    <Button
      className="is-stop"
      tip={text.run.stop}
      keys="Shift+F5"
      icon={<IconPlayerStop {...size} />}
      onClick={run('run.stop')}
    />
  );
  if (looksBack)
    return (
      <div className="runbar" role="group" aria-label={text.run.controls}>
        {stop}
        <PastControls />
      </div>
    );
  return (
    <div className="runbar" role="group" aria-label={text.run.controls}>
      {stop}
      {paused ? (
        <Button
          kind="primary"
          tip={text.run.continue}
          keys="F5"
          disabled={!drives}
          icon={<IconPlayerPlay {...size} />}
          onClick={run('run.start')}
        >
          <span className="runbar__word">{text.run.continue}</span>
        </Button>
      ) : (
        <Button
          className={runs ? 'is-run' : ''}
          tip={runs ? `${text.run.run}: ${text.run.runs}` : text.run.run}
          keys="F5"
          disabled={!drives}
          icon={<IconPlayerPlay {...size} />}
          onClick={run('run.start')}
        />
      )}
      <Button
        tip={text.run.pause}
        keys="F8"
        disabled={!drives || !runs}
        icon={<IconPlayerPause {...size} />}
        onClick={run('run.pause')}
      />
      <Button
        tip={text.run.step}
        keys="F10"
        disabled={!drives || !paused}
        icon={<IconPlayerSkipForward {...size} />}
        onClick={run('run.step')}
      />
    </div>
  );
}
