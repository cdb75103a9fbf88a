import { IconPlayerPause, IconPlayerPlay, IconPlayerStop } from '@tabler/icons-react';
import { runStateOf } from '../../core/run_state';
import { useDrives, usePart, useStudio, useTopic } from '../hooks';
import { kStroke } from '../parts/icons';
import { text } from '../text';

const size = { size: 20, stroke: kStroke, 'aria-hidden': true } as const;

/** Stop, Run, Pause, as large as thumbs are. Stop is for everybody who looks. */
export function PhoneRun() {
  const { registry } = useStudio();
  const drives = useDrives();
  const clock = usePart('clock', {}, (is) => is?.state);
  const state = runStateOf(useTopic('robot', {}), clock && { state: clock }, useTopic('plan', {}));
  const run = (id: string) => () => void registry.run(id);
  return (
    <div className="phone__run" role="group" aria-label={text.run.controls}>
      <button type="button" className="phone__button is-stop" onClick={run('run.stop')}>
        <IconPlayerStop {...size} />
        {text.run.stop}
      </button>
      <button
        type="button"
        className={state === 'running' ? 'phone__button is-run' : 'phone__button'}
        disabled={!drives || state === 'running'}
        onClick={run('run.start')}
      >
        <IconPlayerPlay {...size} />
        {state === 'running'
          ? text.run.running
          : state === 'held'
            ? text.run.continue
            : text.run.run}
      </button>
      <button
        type="button"
        className="phone__button"
        disabled={!drives || state !== 'running'}
        onClick={run('run.pause')}
      >
        <IconPlayerPause {...size} />
        {text.run.pause}
      </button>
    </div>
  );
}
