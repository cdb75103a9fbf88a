// The lines that an arrow may run on, with what is in its way, and the memory of its search.

import { grown, type Box, type Point } from './shape';

/** Between lines of the grid: no box is as narrow, so no step leaps over one. */
const kPitch = 12;

export class Grid {
  private readonly xs: number[];
  private readonly ys: number[];
  private readonly columnOf: Map<number, number>;
  private readonly rowOf: Map<number, number>;
  private readonly covered: Uint8Array;
  private readonly costs: Float64Array;
  private readonly from: Int32Array;
  private readonly seen: Uint8Array;
  private readonly closed: Uint8Array;

  /** Over an area, with more lines through `stubs`; `clear` of each box. */
  constructor(area: Box, boxes: readonly Box[], stubs: readonly Point[], clear: number) {
    const { x, y, width, height } = area;
    this.xs = lines(
      x,
      x + width,
      stubs.map((one) => one.x),
    );
    this.ys = lines(
      y,
      y + height,
      stubs.map((one) => one.y),
    );
    this.columnOf = new Map(this.xs.map((one, index) => [one, index]));
    this.rowOf = new Map(this.ys.map((one, index) => [one, index]));
    const count = this.xs.length * this.ys.length;
    this.covered = new Uint8Array(count);
    for (const box of boxes) this.cover(grown(box, clear));
    this.costs = new Float64Array(count * 4);
    this.from = new Int32Array(count * 4);
    this.seen = new Uint8Array(count * 4);
    this.closed = new Uint8Array(count * 4);
  }

  /** -1: no line goes there, or a box is there. */
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

  /** True if that is cheaper than what was known. */
  reach(state: number, cost: number, from: number): boolean {
    if (this.closed[state]) return false;
    if (this.seen[state] && (this.costs[state] ?? 0) <= cost) return false;
    this.seen[state] = 1;
    this.costs[state] = cost;
    this.from[state] = from;
    return true;
  }

  cost(state: number): number {
    return this.costs[state] ?? 0;
  }

  /** False if it was done before. */
  close(state: number): boolean {
    if (this.closed[state]) return false;
    this.closed[state] = 1;
    return true;
  }

  trail(state: number): Point[] {
    const points: Point[] = [];
    for (let at = state; at >= 0; at = this.from[at] ?? -1) points.unshift(this.at(at >> 2));
    return points;
  }

  private cover(box: Box): void {
    const columns = within(this.xs, box.x, box.x + box.width);
    const rows = within(this.ys, box.y, box.y + box.height);
    for (let row = rows.first; row < rows.end; row++)
      for (let column = columns.first; column < columns.end; column++)
        this.covered[row * this.xs.length + column] = 1;
  }
}

function lines(from: number, to: number, more: readonly number[]): number[] {
  const all = new Set(more);
  const last = Math.floor(to / kPitch);
  for (let line = Math.ceil(from / kPitch); line <= last; line++) all.add(line * kPitch);
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
