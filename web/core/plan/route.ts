// Orthogonal ways for the action arrows: around boxes, at least kApart from arrows to other
// targets, and together with those to the same one. A search over a grid of lines (A*), one arrow
// after the other, the short ones first.

import { Grid, kClear } from './grid';
import { Heap } from './heap';
import { kApart, Lanes } from './lanes';
import type { Box, Point } from './shape';

export type Side = 'left' | 'right' | 'top' | 'bottom';

export interface Port extends Point {
  side: Side;
}

export interface Way {
  id: string;
  from: Port;
  /** Where it may come in. */
  entries: readonly Port[];
  /** Ways with the same aim share their last stretch. */
  aim: string;
}

export interface Routed {
  id: string;
  points: readonly Point[];
}

/** From the edge of a box to the first bend: room for a head of an arrow and its corner. */
const kStubOut = 10;
const kStubIn = 18;
const kHeadRoom = 12;
const kBend = 28;
const kCrossing = 40;
const kShared = 0.4;
/** Of what is looked at first, around source and target. */
const kMargin = 300;
const kMuch = 1e4;

const kSteps = [
  { x: 1, y: 0 },
  { x: 0, y: 1 },
  { x: -1, y: 0 },
  { x: 0, y: -1 },
] as const;
const kOfSide: Record<Side, number> = { right: 0, bottom: 1, left: 2, top: 3 };

export function outOf(port: Port, by: number): Point {
  const { x, y } = kSteps[kOfSide[port.side]] ?? kSteps[0];
  return { x: port.x + x * by, y: port.y + y * by };
}

export function routeAll(boxes: readonly Box[], ways: readonly Way[]): Map<string, Routed> {
  const stubs = ways.flatMap((way) => [
    outOf(way.from, kStubOut),
    ...way.entries.map((entry) => outOf(entry, kStubIn)),
  ]);
  const grid = new Grid(boxes, stubs);
  const lanes = new Lanes();
  for (const way of ways) {
    lanes.add(way.aim, [way.from, outOf(way.from, kStubOut)]);
    // Nobody crosses where a head of an arrow will be.
    for (const entry of way.entries) lanes.add(way.aim, [entry, outOf(entry, kHeadRoom)]);
  }
  const found = new Map<string, Routed>();
  for (const way of [...ways].sort((a, b) => length(a) - length(b))) {
    const points = simplified(new Search(grid, lanes, way).points());
    lanes.add(way.aim, points);
    found.set(way.id, { id: way.id, points });
  }
  return found;
}

function length({ from, entries }: Way): number {
  return Math.min(...entries.map((to) => Math.abs(to.x - from.x) + Math.abs(to.y - from.y)));
}

class Search {
  private readonly begin: Point;

  constructor(
    private readonly grid: Grid,
    private readonly lanes: Lanes,
    private readonly way: Way,
  ) {
    this.begin = outOf(way.from, kStubOut);
  }

  /** First near by and strictly, then everywhere, then across others; straight if boxes cover it. */
  points(): Point[] {
    return (
      this.find(kMargin, false) ??
      this.find(Infinity, false) ??
      this.find(Infinity, true) ??
      this.straight()
    );
  }

  private find(margin: number, across: boolean): Point[] | null {
    const { grid } = this;
    const start = grid.node(this.begin);
    const first = kOfSide[this.way.from.side];
    const goals = this.goals();
    const near = this.near(margin);
    grid.begin();
    const heap = new Heap();
    grid.reach(start * 4 + first, 0, -1);
    heap.push(this.hope(this.begin, goals), start * 4 + first);
    for (let state = heap.pop(); state >= 0; state = heap.pop()) {
      if (!grid.close(state)) continue;
      const goal = goals.get(state);
      if (goal) return [this.way.from, ...grid.trail(state), goal];
      this.expand(state, near, across, heap, goals);
    }
    return null;
  }

  private expand(
    state: number,
    near: (at: Point) => boolean,
    across: boolean,
    heap: Heap,
    goals: ReadonlyMap<number, Port>,
  ): void {
    const { grid } = this;
    const node = state >> 2;
    const at = grid.at(node);
    const cost = grid.cost(state);
    for (let turn = 0; turn < 4; turn++) {
      // Never back the way it came.
      if (((state & 3) ^ 2) === turn) continue;
      const next = grid.next(node, turn);
      if (next < 0) continue;
      const to = grid.at(next);
      if (!near(to)) continue;
      const step = this.step(at, to, across);
      if (step === null) continue;
      const total = cost + step + (turn === (state & 3) ? 0 : kBend);
      if (grid.reach(next * 4 + turn, total, state))
        heap.push(total + this.hope(to, goals), next * 4 + turn);
    }
  }

  /** What a step costs; null: it is taken. */
  private step(from: Point, to: Point, across: boolean): number | null {
    const length = Math.abs(to.x - from.x) + Math.abs(to.y - from.y);
    const { blocked, crossings, shared } = this.lanes.meet(this.way.aim, from, to);
    if (blocked && !across) return null;
    return length * (shared ? kShared : 1) + crossings * kCrossing + (blocked ? kMuch : 0);
  }

  /** States in which an entry is reached, going in its direction. */
  private goals(): Map<number, Port> {
    const goals = new Map<number, Port>();
    for (const entry of this.way.entries) {
      const node = this.grid.node(outOf(entry, kStubIn));
      if (node >= 0) goals.set(node * 4 + (kOfSide[entry.side] ^ 2), entry);
    }
    return goals;
  }

  private hope(at: Point, goals: ReadonlyMap<number, Port>): number {
    let least = Infinity;
    for (const goal of goals.values())
      least = Math.min(least, Math.abs(goal.x - at.x) + Math.abs(goal.y - at.y) - kStubIn);
    return Math.max(0, least) * kShared;
  }

  private near(margin: number): (at: Point) => boolean {
    if (margin === Infinity) return () => true;
    const all = [this.begin, ...this.way.entries];
    const left = Math.min(...all.map(({ x }) => x)) - margin;
    const right = Math.max(...all.map(({ x }) => x)) + margin;
    const top = Math.min(...all.map(({ y }) => y)) - margin;
    const bottom = Math.max(...all.map(({ y }) => y)) + margin;
    return ({ x, y }) => x >= left && x <= right && y >= top && y <= bottom;
  }

  private straight(): Point[] {
    const [entry] = this.way.entries;
    if (!entry) return [this.way.from, this.begin];
    const end = outOf(entry, kStubIn);
    return [this.way.from, this.begin, { x: this.begin.x, y: end.y }, end, entry];
  }
}

/** Without points in the middle of a straight line. */
export function simplified(points: readonly Point[]): Point[] {
  const kept: Point[] = [];
  for (const { x, y } of points) {
    const before = kept.at(-1);
    const first = kept.at(-2);
    if (before && before.x === x && before.y === y) continue;
    if (
      before &&
      first &&
      ((first.x === before.x && before.x === x) || (first.y === before.y && before.y === y))
    )
      kept.pop();
    kept.push({ x, y });
  }
  return kept;
}

export { kApart, kClear };
