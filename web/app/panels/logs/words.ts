// Words of log points: apart from text.ts, as they come with their panel.

import type { LogPlace, LogPoint } from '../../../core/logs';
import { counted } from '../../text';

export const logWords = {
  nothing: 'No log points.',
  how: 'What did a variable hold each time? Put the caret on a line of a script, or select an actor or a supervisor of the plan, and press Shift+F9. The recorded run is run again, and each time that the place was reached is listed here.',
  points: 'Log points',
  hits: 'Times that they were reached, the oldest first',
  values: (place: string) => `Values at ${place}`,
  hintOfScript: 'token, list[0] + 1',
  hintOfPlan: 'walldist, wallangle / 2',
  needsValues: 'Enter what is shown, with commas between, then press Enter.',
  when: (element: string) => `When ${element} is looked at`,
  enter: 'begins',
  leave: 'ends',
  raise: 'raises',
  ask: 'Ask',
  again: 'Ask again',
  cancel: 'Cancel',
  waits: 'The run is run again…',
  takesLong:
    'The run is still being run again. A long run takes a while; it ends after 120 s at the latest.',
  queued: 'Waits for the one before.',
  other: 'Not asked of this run.',
  none: 'Not reached in this run.',
  found: (count: number) => counted(count, 'hit', 'hits'),
  until: (t: string) => `until ${t} s`,
  more: (count: number) => `${counted(count, 'more hit is', 'more hits are')} not listed.`,
  lineThen: 'In the recording that line was:',
  remove: (place: string) => `Remove the log point ${place}`,
  table: 'The table for other programs',
  copy: 'Copy as CSV',
  copied: 'The table',
  save: 'Save as CSV',
};

/** "drive:12", "followWall begins". */
export function placeName(place: LogPlace, nameOf: (doc: string) => string): string {
  if (place.is === 'line') return `${nameOf(place.doc)}:${place.line}`;
  return `${place.element} ${logWords[place.when]}`;
}

/** How its question stands. */
export function stateOf({ state, found, values }: LogPoint, isAsked: boolean): string {
  if (state === 'waits') return isAsked ? logWords.waits : logWords.queued;
  if (state === 'told' && found)
    return found.hits.length > 0 ? logWords.found(found.hits.length + found.more) : logWords.none;
  return state === 'typed' && values !== '' ? logWords.other : '';
}
