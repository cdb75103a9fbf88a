// Orthogonal ways for the action arrows: around boxes, at least kApart from arrows to other
// targets, and together with those to the same one. A search over a grid of lines (A*), one arrow
// after the other, the short ones first.

import { Field, meetingOf } from './field';
import type { Grid } from './grid';
import { Heap } from './heap';
import { kApart, Lanes } from './lanes';
import { eachStretch, stretchBox, type Routed } from './path';
import { around, grown, overlaps, type Box, type Point } from './shape';

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

/** What an arrow needs: from its source to the first bend, from the last one to its target, and beside a box. */
interface Room {
  out: number;
  in: number;
  clear: number;
}

/** For a head of an arrow and its corner. */
const kRoomy: Room = { out: 10, in: 18, clear: 7 };
/** Between boxes that stand close together. */
export const kTight: Room = { out: 3, in: 3, clear: 1 };
const kHeadRoom = 12;
const kBend = 28;
const kCrossing = 40;
const kShared = 0.4;
/** Of what is looked at first, around source and target. */
const kMargin = 300;
const kFar = 1500;
/** Of more arrows each is found soon rather than best. */
const kMany = 40;
/** How much the way that is left counts: less than it costs finds the best one, more one soon. */
const kCareful = kShared;
const kHasty = 1.6;
/** Places that are looked at before a search ends without a way. */
const kLooksMax = 12_000;
/** Where there is no room an arrow runs beside others, as little as can be found soon. */
const kBeside = 4;

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

/** The ways of all arrows of a drawing, found one after the other: all at once, or bit by bit. */
export class Routing {
  readonly found = new Map<string, Routed>();
  private readonly field: Field;
  private readonly lanes = new Lanes();
  /** The longest first: they are taken from the end. */
  private readonly left: Way[];
  private readonly haste: number;

  constructor(boxes: readonly Box[], ways: readonly Way[]) {
    const stubs = ways.flatMap((way) => [
      outOf(way.from, kRoomy.out),
      ...way.entries.map((entry) => outOf(entry, kRoomy.in)),
    ]);
    this.field = new Field(boxes, stubs);
    for (const way of ways) {
      this.lanes.add(way.aim, [way.from, outOf(way.from, kRoomy.out)]);
      // Nobody crosses where a head of an arrow will be.
      for (const entry of way.entries) this.lanes.add(way.aim, [entry, outOf(entry, kHeadRoom)]);
    }
    this.haste = ways.length > kMany ? kHasty : kCareful;
    this.left = [...ways].sort((a, b) => length(b) - length(a));
  }

  /** True when all are found. */
  get done(): boolean {
    return this.left.length === 0;
  }

  /** Keeps a way as it is, if its ends are the same and no box is on it. */
  keep({ id, points }: Routed): void {
    const at = this.left.findIndex((way) => way.id === id);
    const way = this.left[at];
    if (!way || !this.isFree(way, points)) return;
    this.left.splice(at, 1);
    this.take(way, points);
  }

  /** Finds one, and goes on until all are found or it is time to stop. */
  work(isTime: () => boolean): void {
    do {
      const way = this.left.pop();
      if (!way) return;
      this.take(way, simplified(new Search(this.field, this.lanes, way, this.haste).points()));
    } while (!isTime());
  }

  /** What is not found yet: as it was, if its ends are where they were, else straight. */
  rest(before: ReadonlyMap<string, Routed>): Routed[] {
    return this.left.map((way) => {
      const known = before.get(way.id);
      return known && joins(way, known.points)
        ? known
        : { id: way.id, points: simplified(straight(way)) };
    });
  }

  private take(way: Way, points: readonly Point[]): void {
    this.lanes.add(way.aim, points);
    this.found.set(way.id, { id: way.id, points });
  }

  private isFree(way: Way, points: readonly Point[]): boolean {
    let isFree = joins(way, points);
    eachStretch(points, (a, b) => {
      const stretch = stretchBox(a, b);
      for (const box of this.field.near(stretch)) if (overlaps(box, stretch)) isFree = false;
    });
    return isFree;
  }
}

/** The points begin and end where the way does. */
function joins({ from, entries }: Way, points: readonly Point[]): boolean {
  const [first] = points;
  const last = points.at(-1);
  if (!first || !last || first.x !== from.x || first.y !== from.y) return false;
  return entries.some(({ x, y }) => x === last.x && y === last.y);
}

function length({ from, entries }: Way): number {
  return Math.min(...entries.map((to) => Math.abs(to.x - from.x) + Math.abs(to.y - from.y)));
}

class Search {
  private readonly begin: Point;
  private readonly ends: readonly Point[];

  constructor(
    private readonly field: Field,
    private readonly lanes: Lanes,
    private readonly way: Way,
    private readonly haste: number,
    private readonly room = kRoomy,
  ) {
    this.begin = outOf(way.from, room.out);
    this.ends = [this.begin, ...way.entries.map((entry) => outOf(entry, room.in))];
  }

  /**
   * First near by and strictly, then farther, then across others, last between boxes that stand close together, also
   * around all of them. Straight only if a box stands on one of its ends.
   */
  points(): Point[] {
    return (
      this.find(kMargin, false) ??
      (this.haste > 1 ? null : this.find(kFar, false)) ??
      this.find(kFar, true) ??
      new Search(this.field, this.lanes, this.way, this.haste, kTight).squeezed() ??
      straight(this.way)
    );
  }

  /** With lines through the gaps around its ends. */
  private squeezed(): Point[] | null {
    const beside = [...this.field.near(this.area(kMargin))].flatMap((box) => {
      const { x, y, width, height } = grown(box, 2 * this.room.clear);
      return [
        { x, y },
        { x: x + width, y: y + height },
      ];
    });
    return this.find(Infinity, true, beside);
  }

  private find(margin: number, across: boolean, more: readonly Point[] = []): Point[] | null {
    const grid = this.field.grid(this.area(margin), [...this.ends, ...more], this.room.clear);
    const start = grid.node(this.begin);
    if (start < 0) return null;
    const first = kOfSide[this.way.from.side];
    const goals = this.goals(grid);
    const heap = new Heap();
    grid.reach(start * 4 + first, 0, -1);
    const haste = across ? Math.max(1, this.haste) : this.haste;
    heap.push(this.hope(this.begin, goals, haste), start * 4 + first);
    let looked = 0;
    for (let state = heap.pop(); state >= 0; state = heap.pop()) {
      if (!grid.close(state)) continue;
      const goal = goals.get(state);
      if (goal) return [this.way.from, ...grid.trail(state), goal];
      if (++looked > kLooksMax && !across) return null;
      this.expand(grid, state, across, heap, goals, haste);
    }
    return null;
  }

  /** Around source and target. */
  private area(margin: number): Box {
    if (margin === Infinity) return this.field.whole;
    const all = around(this.ends.map((one) => ({ ...one, width: 0, height: 0 })));
    return meetingOf(grown(all, margin), this.field.whole);
  }

  private expand(
    grid: Grid,
    state: number,
    across: boolean,
    heap: Heap,
    goals: ReadonlyMap<number, Port>,
    haste: number,
  ): void {
    const node = state >> 2;
    const at = grid.at(node);
    const cost = grid.cost(state);
    for (let turn = 0; turn < 4; turn++) {
      // Never back the way it came.
      if (((state & 3) ^ 2) === turn) continue;
      const next = grid.next(node, turn);
      if (next < 0) continue;
      const to = grid.at(next);
      const step = this.step(at, to, across);
      if (step === null) continue;
      const total = cost + step + (turn === (state & 3) ? 0 : kBend);
      if (grid.reach(next * 4 + turn, total, state))
        heap.push(total + this.hope(to, goals, haste), next * 4 + turn);
    }
  }

  /** What a step costs; null: it is taken. */
  private step(from: Point, to: Point, across: boolean): number | null {
    const length = Math.abs(to.x - from.x) + Math.abs(to.y - from.y);
    const { blocked, crossings, shared } = this.lanes.meet(this.way.aim, from, to);
    if (blocked && !across) return null;
    if (across) return length * (blocked ? kBeside : 1);
    return length * (shared ? kShared : 1) + crossings * kCrossing;
  }

  /** States in which an entry is reached, going in its direction. */
  private goals(grid: Grid): Map<number, Port> {
    const goals = new Map<number, Port>();
    for (const entry of this.way.entries) {
      const node = grid.node(outOf(entry, this.room.in));
      if (node >= 0) goals.set(node * 4 + (kOfSide[entry.side] ^ 2), entry);
    }
    return goals;
  }

  private hope(at: Point, goals: ReadonlyMap<number, Port>, haste: number): number {
    let least = Infinity;
    for (const goal of goals.values())
      least = Math.min(least, Math.abs(goal.x - at.x) + Math.abs(goal.y - at.y) - this.room.in);
    return Math.max(0, least) * haste;
  }
}

function straight({ from, entries }: Way): Point[] {
  const begin = outOf(from, kRoomy.out);
  const [entry] = entries;
  if (!entry) return [from, begin];
  const end = outOf(entry, kRoomy.in);
  return [from, begin, { x: begin.x, y: end.y }, end, entry];
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

export { kApart };
