// The ways that robots took.

import { distance, type Point } from './geometry';

/** Points closer than this to the last one are not kept, in m. */
export const kTrailStep = 0.01;
export const kTrailPointsMax = 4000;
/** A robot that is farther from its last place was put there, in m. */
const kJump = 0.5;

export interface TrailPoint extends Point {
  /** When it was there, in seconds of the run. */
  t: number;
  /** The line does not lead here: a hand put the robot down. */
  begins: boolean;
}

export class Trails {
  private readonly ways = new Map<string, TrailPoint[]>();
  private last = -Infinity;

  /** Metres that are shown; Infinity: all. */
  constructor(public limit = 20) {}

  /** The time of the newest frame; -Infinity before the first one. */
  get now(): number {
    return this.last;
  }

  /** The time of a frame; going back begins again. */
  at(t: number): void {
    if (t < this.last - 1e-6) this.clear();
    this.last = t;
  }

  add(key: string, point: Point): void {
    if (!Number.isFinite(point.x)) return;
    const way = this.ways.get(key) ?? [];
    if (way.length === 0) this.ways.set(key, way);
    push(way, { x: point.x, y: point.y, t: this.last });
    if (way.length > kTrailPointsMax) way.splice(0, way.length - kTrailPointsMax);
  }

  /** Where it went while nobody looked: between what is known of before and of after. */
  fill(key: string, points: readonly (Point & { t: number })[]): void {
    const [from, to] = [points[0]?.t, points.at(-1)?.t];
    if (from === undefined || to === undefined) return;
    const known = this.ways.get(key) ?? [];
    const before = known.filter(({ t }) => t < from);
    const after = known.filter(({ t }) => t > to);
    const way: TrailPoint[] = [];
    for (const point of [...before, ...points, ...after]) push(way, point);
    this.ways.set(key, way.slice(-kTrailPointsMax));
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

function push(way: TrailPoint[], { x, y, t }: Point & { t: number }): void {
  const before = way.at(-1);
  const far = before ? distance(before, { x, y }) : Infinity;
  if (far >= kTrailStep) way.push({ x, y, t, begins: far > kJump });
}
