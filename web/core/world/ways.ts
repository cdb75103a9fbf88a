// The trails of the run, one for all views: what nobody looked at, before a reload or behind another
// panel, is asked from the history of the server.

import type { Commands, Json } from '../../protocol/messages';
import { Emitter } from '../emitter';
import type { Point } from './geometry';
import { Trails } from './trails';

/** Frames farther apart than this are no stream: what lies between was not seen, in s of the run. */
export const kWayGap = 0.5;

type Ask = (input: Commands['history.ways']['in']) => Promise<Commands['history.ways']['out']>;

export class Ways {
  readonly trails = new Trails();
  /** Something was filled in. */
  readonly changed = new Emitter<void>();
  /** Nothing before is wanted. */
  private from = 0;

  constructor(private readonly ask: Ask) {}

  /** Before a frame of poses is shown; keys of robots in the order of the scene. */
  frame(t: number, keys: readonly string[]): void {
    const last = this.trails.now;
    if (t < last) this.from = 0;
    const seen = t < last ? 0 : Math.max(last, this.from);
    if (t - seen > kWayGap) void this.fill(seen, t, keys);
  }

  clear(): void {
    this.from = Math.max(0, this.trails.now);
    this.trails.clear();
  }

  /** Another project. */
  forget(): void {
    this.trails.clear();
    this.trails.at(-Infinity);
    this.from = 0;
  }

  private async fill(from: number, to: number, keys: readonly string[]): Promise<void> {
    try {
      const { ways } = await this.ask({ from, to });
      // Cleared, or back at the start meanwhile.
      if (this.from > from || this.trails.now < to) return;
      for (const way of ways) {
        const { robot, points } = read(way);
        const key = keys[robot];
        if (key !== undefined) this.trails.fill(key, points);
      }
      this.changed.emit();
    } catch {
      // Nothing is kept of it, or there is no server: the trail begins where it is seen.
    }
  }
}

function read(way: Json): { robot: number; points: (Point & { t: number })[] } {
  const numbers = Array.isArray(way) ? way.map(Number) : [];
  const points = [];
  for (let at = 1; at + 2 < numbers.length; at += 3) {
    const [t = NaN, x = NaN, y = NaN] = numbers.slice(at, at + 3);
    if (Number.isFinite(t + x + y)) points.push({ t, x, y });
  }
  return { robot: numbers[0] ?? -1, points };
}
