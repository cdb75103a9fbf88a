// Words of breakpoints and of events that wait while a plan is paused: apart from text.ts, as they come with that panel alone.

import { counted } from '../../text';

export const breakWords = {
  none: 'None. Press F9 at a line of a script or at an element of a plan.',
  from: (hit: number) => `from hit ${hit}`,
  holds: 'paused here',
  when: 'Stop when',
  whenHint: 'a formula, such as distance < 5',
  add: 'Add',
};

export const heldWords = {
  title: 'Held events',
  why: 'wait while the plan is paused; released events are handled when it continues',
  host: 'a host',
  go: 'Release',
  step: 'Step',
  drop: 'Drop',
  goAll: 'Release all',
  dropAll: 'Drop all',
  none: 'No events since.',
  after: (seconds: number) => `+${seconds.toFixed(3)}`,
  more: (count: number) => `${counted(count, 'more waits', 'more wait')} behind these.`,
  dropped: (count: number) =>
    `${counted(count, 'event was', 'events were')} dropped: no more than 1000 can wait.`,
  droppedByNodes: 'Dropped by paused nodes',
  nodeDropped: (node: string, count: number | undefined) =>
    count === undefined
      ? `${node} is paused and drops its events; how many is not known.`
      : `${node} is paused and has dropped ${count === 0 ? 'no event' : counted(count, 'event', 'events')} of its own.`,
};
