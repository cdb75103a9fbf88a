import { IconAlertTriangle } from '@tabler/icons-react';
import { useDrives, usePart, useStudio } from '../hooks';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { text } from '../text';
import { Notice } from './notice';

/** A run that died says why, and begins again with one press. */
export function RunNotice() {
  const { registry } = useStudio();
  const drives = useDrives();
  const state = usePart('clock', {}, (is) => is?.state);
  const why = usePart('clock', {}, (is) => is?.why);
  if (state !== 'dead' && state !== 'hanging') return null;
  const dead = state === 'dead';
  const icon = <IconAlertTriangle className="icon" size={14} stroke={kStroke} aria-hidden />;
  const end = (
    <Button
      small
      disabled={!drives}
      keys={dead ? 'F5' : undefined}
      onClick={() => void registry.run(dead ? 'run.start' : 'run.end')}
    >
      {dead ? text.run.again : text.run.end}
    </Button>
  );
  return (
    <Notice icon={icon} error={dead} end={end}>
      {dead ? (why ?? text.run.dead) : text.run.hangs}
    </Notice>
  );
}
