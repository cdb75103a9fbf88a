import {
  IconPlayerPause,
  IconPlayerPlay,
  IconPlayerSkipForward,
  IconRotate2,
} from '@tabler/icons-react';
import { hasNotBegun } from '../../../core/run_choice';
import { usePart, useStudio } from '../../hooks';
import { useMayAct } from '../../past_hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { Segments } from '../../parts/segments';
import { text } from '../../text';

const words = text.world;
/** In which it can be run, paused, set back; "none": it is at its start, or after Stop. */
const kStates: readonly string[] = ['none', 'running', 'paused'];
const speeds = [0.1, 0.5, 1, 2, 5, 10, 0].map((value) => ({
  value: value,
  words: words.slower(value),
}));
const size = { size: 14, stroke: kStroke };

/** How fast the simulation goes: from one instant at a time to as fast as it can. */
export function SpeedBar() {
  const studio = useStudio();
  const drives = useMayAct();
  const state = usePart('clock', {}, (is) => is?.state);
  const ready = usePart('clock', {}, hasNotBegun);
  const speed = usePart('clock', {}, (is) => is?.speed);
  const real = usePart('clock', {}, (is) => is?.real.toFixed(1) ?? '');
  const simulates = usePart('robot', {}, (is) => is?.kind === 'simulator');
  if (!state || !simulates || !kStates.includes(state)) return null;
  const runs = state === 'running';
  const atStart = state === 'none';
  const run = (id: string) => () => void studio.registry.run(id);
  return (
    <div className="speedbar" role="group" aria-label={words.speeds}>
      <Button
        kind="plain"
        small
        disabled={!drives}
        tip={runs ? words.pause : atStart ? text.run.run : text.run.continue}
        icon={runs ? <IconPlayerPause {...size} /> : <IconPlayerPlay {...size} />}
        onClick={run(runs ? 'run.pause' : 'run.start')}
      />
      <Button
        kind="plain"
        small
        disabled={!drives || runs}
        tip={words.step}
        icon={<IconPlayerSkipForward {...size} />}
        onClick={() => studio.order('run.step', {})}
      />
      <Segments
        small
        numbers
        label={words.speeds}
        segments={speeds}
        chosen={speed}
        disabled={!drives}
        onChoose={(one) => one !== undefined && studio.order('clock.speed', { speed: one })}
      />
      <span className="speedbar__real num">
        {runs ? words.measured(real) : ready ? text.run.ready : text.run[state]}
      </span>
      <Button
        kind="plain"
        small
        disabled={!drives}
        tip={words.reset}
        icon={<IconRotate2 {...size} />}
        onClick={run('run.reset')}
      />
    </div>
  );
}
