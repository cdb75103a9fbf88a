import { IconHandStop } from '@tabler/icons-react';
import { answers } from '../../core/connection';
import type { RunEnd, StopNode } from '../../protocol/messages';
import { useChanges, useLink, useStudio, useTopic } from '../hooks';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { text } from '../text';
import { Notice } from './notice';

/** Stop that did not arrive, and nodes that were not read back as stopped: until somebody acknowledges it. */
export function EndNotice() {
  const studio = useStudio();
  useChanges(studio.stopping.changed);
  const link = useLink();
  const told = useTopic('end', {});
  const icon = <IconHandStop className="icon" size={14} stroke={kStroke} aria-hidden />;
  if (studio.stopping.waits && !answers(link))
    return (
      <Notice icon={icon} error>
        {text.stop.notDelivered}
      </Notice>
    );
  if (!told?.open || !told.end) return null;
  const { end } = told;
  const acknowledge = (
    <Button small onClick={() => studio.order('end.acknowledge', { number: end.number })}>
      {text.stop.acknowledge}
    </Button>
  );
  return (
    <Notice icon={icon} error end={acknowledge}>
      {sentence(end)}
    </Notice>
  );
}

function sentence({ nodes }: RunEnd): string {
  const missing = nodes.filter(({ state }) => state !== 'stopped');
  return missing.length === 0
    ? text.stop.noNodes
    : `${text.stop.notStopped} ${missing.map(described).join(', ')}. ${text.stop.asked}`;
}

function described({ node, name, state }: StopNode): string {
  return `${name || node} ${text.stop.states[state]}`;
}
