// The stretches that arrows have taken, found by where they run.

import type { Point } from './shape';

/** Between parallel arrows that lead to different places. */
export const kApart = 9;

interface Stretch {
  aim: string;
  /** The line it runs on: y of a horizontal one, x of a vertical one. */
  on: number;
  from: number;
  to: number;
}

export interface Meeting {
  /** It would run on or beside another, or touch its end. */
  blocked: boolean;
  crossings: number;
  /** It runs on a way to the same place. */
  shared: boolean;
}

const kAlong = 120;

export class Lanes {
  private readonly level = new Shelf();
  private readonly upright = new Shelf();

  add(aim: string, points: readonly Point[]): void {
    points.slice(1).forEach((to, index) => {
      const from = points[index];
      if (!from) return;
      if (from.y === to.y) this.level.put(aim, from.y, from.x, to.x);
      else this.upright.put(aim, from.x, from.y, to.y);
    });
  }

  meet(aim: string, from: Point, to: Point): Meeting {
    const isLevel = from.y === to.y;
    const [own, others] = isLevel ? [this.level, this.upright] : [this.upright, this.level];
    const on = isLevel ? from.y : from.x;
    const begin = isLevel ? from.x : from.y;
    const end = isLevel ? to.x : to.y;
    const meeting: Meeting = { blocked: false, crossings: 0, shared: false };
    alongside(own, aim, on, begin, end, meeting);
    if (!meeting.blocked) across(others, aim, on, begin, end, meeting);
    return meeting;
  }
}

function alongside(
  shelf: Shelf,
  aim: string,
  on: number,
  begin: number,
  end: number,
  meeting: Meeting,
): void {
  const low = Math.min(begin, end);
  const high = Math.max(begin, end);
  shelf.each(on - kApart, on + kApart, low, high, (one) => {
    const apart = Math.abs(one.on - on);
    if (apart >= kApart || Math.min(high, one.to) - Math.max(low, one.from) <= 0) return;
    if (one.aim === aim && apart === 0) meeting.shared = true;
    else meeting.blocked = true;
  });
}

/** A crossing well inside of both is one; near an end it would look like a junction. */
function across(
  shelf: Shelf,
  aim: string,
  on: number,
  begin: number,
  end: number,
  meeting: Meeting,
): void {
  const low = Math.min(begin, end);
  const high = Math.max(begin, end);
  shelf.each(low, high, on - kApart, on + kApart, (one) => {
    if (one.aim === aim || one.on === begin) return;
    if (one.on < low || one.on > high) return;
    if (one.from - kApart >= on || one.to + kApart <= on) return;
    if (one.from + kApart <= on && one.to - kApart >= on) meeting.crossings++;
    else meeting.blocked = true;
  });
}

/** Parallel stretches in bins of kApart across and kAlong along. */
class Shelf {
  private readonly bins = new Map<number, Stretch[]>();

  put(aim: string, on: number, a: number, b: number): void {
    const stretch = { aim, on, from: Math.min(a, b), to: Math.max(a, b) };
    const row = Math.floor(on / kApart);
    const last = Math.floor(stretch.to / kAlong);
    for (let column = Math.floor(stretch.from / kAlong); column <= last; column++) {
      const key = keyOf(row, column);
      const bin = this.bins.get(key);
      if (bin) bin.push(stretch);
      else this.bins.set(key, [stretch]);
    }
  }

  each(
    onFrom: number,
    onTo: number,
    from: number,
    to: number,
    act: (stretch: Stretch) => void,
  ): void {
    const lastRow = Math.floor(onTo / kApart);
    const firstColumn = Math.floor(from / kAlong);
    const lastColumn = Math.floor(to / kAlong);
    for (let row = Math.floor(onFrom / kApart); row <= lastRow; row++)
      for (let column = firstColumn; column <= lastColumn; column++)
        for (const one of this.bins.get(keyOf(row, column)) ?? [])
          // One that lies in several bins counts once.
          if (column === firstColumn || Math.floor(one.from / kAlong) === column) act(one);
  }
}

/** Far beyond what a canvas has of either. */
const kColumns = 1 << 20;

function keyOf(row: number, column: number): number {
  return row * kColumns + column + kColumns / 2;
}
