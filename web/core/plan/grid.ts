// The lines that arrows may run on, with what stands in their way, and the memory of one search.

import type { Box, Point } from './shape';

/** Between an arrow and a box. */
export const kClear = 7;
/** Between lines of the grid: no box is as narrow, so no step leaps over one. */
const kPitch = 12;
const kRim = 96;

export class Grid {
  private readonly xs: number[];
  private readonly ys: number[];
  private readonly columnOf: Map<number, number>;
  private readonly rowOf: Map<number, number>;
  private readonly covered: Uint8Array;
  private readonly costs: Float64Array;
  private readonly from: Int32Array;
  private readonly seen: Uint32Array;
  private readonly closed: Uint32Array;
  private round = 0;

  constructor(boxes: readonly Box[], stubs: readonly Point[]) {
    const left = [...boxes.map((box) => box.x), ...stubs.map(({ x }) => x)];
    const right = [...boxes.map((box) => box.x + box.width), ...stubs.map(({ x }) => x)];
    const top = [...boxes.map((box) => box.y), ...stubs.map(({ y }) => y)];
    const bottom = [...boxes.map((box) => box.y + box.height), ...stubs.map(({ y }) => y)];
    this.xs = lines(
      least(left),
      most(right),
      stubs.map(({ x }) => x),
    );
    this.ys = lines(
      least(top),
      most(bottom),
      stubs.map(({ y }) => y),
    );
    this.columnOf = new Map(this.xs.map((x, index) => [x, index]));
    this.rowOf = new Map(this.ys.map((y, index) => [y, index]));
    const count = this.xs.length * this.ys.length;
    this.covered = new Uint8Array(count);
    for (const box of boxes) this.cover(box);
    this.costs = new Float64Array(count * 4);
    this.from = new Int32Array(count * 4);
    this.seen = new Uint32Array(count * 4);
    this.closed = new Uint32Array(count * 4);
  }

  /** -1: no line goes there, or a box stands there. */
  node({ x, y }: Point): number {
    const column = this.columnOf.get(x);
    const row = this.rowOf.get(y);
    if (column === undefined || row === undefined) return -1;
    return row * this.xs.length + column;
  }

  at(node: number): Point {
    const columns = this.xs.length;
    return { x: this.xs[node % columns] ?? 0, y: this.ys[Math.floor(node / columns)] ?? 0 };
  }

  /** Right, down, left, up; -1: there is nothing free. */
  next(node: number, turn: number): number {
    const columns = this.xs.length;
    const column = node % columns;
    if (turn === 0 && column === columns - 1) return -1;
    if (turn === 2 && column === 0) return -1;
    const next = node + (turn === 0 ? 1 : turn === 2 ? -1 : turn === 1 ? columns : -columns);
    return next >= 0 && next < this.covered.length && !this.covered[next] ? next : -1;
  }

  begin(): void {
    this.round++;
  }

  /** True if that is cheaper than what was known. */
  reach(state: number, cost: number, from: number): boolean {
    if (this.closed[state] === this.round) return false;
    if (this.seen[state] === this.round && (this.costs[state] ?? 0) <= cost) return false;
    this.seen[state] = this.round;
    this.costs[state] = cost;
    this.from[state] = from;
    return true;
  }

  cost(state: number): number {
    return this.costs[state] ?? 0;
  }

  /** False if it was done before. */
  close(state: number): boolean {
    if (this.closed[state] === this.round) return false;
    this.closed[state] = this.round;
    return true;
  }

  trail(state: number): Point[] {
    const points: Point[] = [];
    for (let at = state; at >= 0; at = this.from[at] ?? -1) points.unshift(this.at(at >> 2));
    return points;
  }

  private cover(box: Box): void {
    const columns = within(this.xs, box.x - kClear, box.x + box.width + kClear);
    const rows = within(this.ys, box.y - kClear, box.y + box.height + kClear);
    for (let row = rows.first; row < rows.end; row++)
      for (let column = columns.first; column < columns.end; column++)
        this.covered[row * this.xs.length + column] = 1;
  }
}

function lines(from: number, to: number, more: readonly number[]): number[] {
  const all = new Set(more);
  const first = Math.floor((from - kRim) / kPitch);
  const last = Math.ceil((to + kRim) / kPitch);
  for (let line = first; line <= last; line++) all.add(line * kPitch);
  return [...all].sort((a, b) => a - b);
}

/** The indices of the lines that lie strictly between. */
function within(lines: readonly number[], from: number, to: number) {
  return { first: firstAbove(lines, from), end: firstAbove(lines, to - 1e-6) };
}

function firstAbove(lines: readonly number[], value: number): number {
  let low = 0;
  let high = lines.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((lines[middle] ?? 0) > value) high = middle;
    else low = middle + 1;
  }
  return low;
}

function least(values: readonly number[]): number {
  return values.reduce((a, b) => Math.min(a, b), values[0] ?? 0);
}

function most(values: readonly number[]): number {
  return values.reduce((a, b) => Math.max(a, b), values[0] ?? 0);
}
