// The ways that robots took.

import { distance, type Point } from './geometry';

/** Points closer than this to the last one are not kept, in m. */
export const kTrailStep = 0.01;
export const kTrailPointsMax = 4000;
/** A robot that is farther from its last place was put there, in m. */
const kJump = 0.5;

export interface TrailPoint extends Point {
  /** The line does not lead here: a hand put the robot down. */
  begins: boolean;
}

export class Trails {
  private readonly ways = new Map<string, TrailPoint[]>();
  private last = -Infinity;

  /** Metres that are kept; Infinity: all. */
  constructor(public limit = 20) {}

  /** The time of a frame; going back begins again. */
  at(t: number): void {
    if (t < this.last - 1e-6) this.clear();
    this.last = t;
  }

  add(key: string, point: Point): void {
    if (!Number.isFinite(point.x)) return;
    const way = this.ways.get(key) ?? [];
    if (way.length === 0) this.ways.set(key, way);
    const before = way.at(-1);
    const far = before ? distance(before, point) : Infinity;
    if (far < kTrailStep) return;
    way.push({ x: point.x, y: point.y, begins: far > kJump });
    if (way.length > kTrailPointsMax) way.splice(0, way.length - kTrailPointsMax);
  }

  /** The newest part of a way, as long as the limit allows. */
  of(key: string): readonly TrailPoint[] {
    const way = this.ways.get(key) ?? [];
    if (this.limit === Infinity) return way;
    let length = 0;
    for (let index = way.length - 1; index > 0; index--) {
      const [a, b] = [way[index], way[index - 1]];
      if (a && b && !a.begins) length += distance(a, b);
      if (length > this.limit) return way.slice(index);
    }
    return way;
  }

  clear(): void {
    this.ways.clear();
  }
}
