// What a lane is drawn with: which seconds, how wide, and what fits where.

import type { Span } from '../../../core/ring';
import { placeIn } from '../../../core/timeline';
import type { HistoryLane } from './rows';

/** A letter of the interface at its smallest, in pixels. */
const kLetter = 6.4;

export interface LaneView {
  span: Span;
  /** The seconds that the server's answer is about. */
  answered: Span;
  width: number;
  /** The instant that is shown, and until when something is known. */
  at: number;
  end: number;
}

export interface LaneShape {
  lane: HistoryLane;
  view: LaneView;
  height: number;
}
export type LaneBar = HistoryLane['bars'][number];

export function extentOf({ from, to }: LaneBar, { span, width, end }: LaneView) {
  const x = Math.max(-2, placeIn(span, from, width));
  const right = Math.min(width + 2, placeIn(span, to ?? end, width));
  return { x, width: Math.max(1.5, right - x) };
}

/** As much of a name as there is room for, or nothing. */
export function fitting(name: string, room: number): string {
  const letters = Math.floor(room / kLetter);
  if (name.length <= letters) return name;
  return letters >= 5 ? `${name.slice(0, letters - 1)}…` : '';
}
