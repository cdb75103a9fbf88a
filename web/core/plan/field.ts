// What is on a canvas, found by where it is, so that a search looks only at what is near.

import { Cells } from './cells';
import { Grid } from './grid';
import { around, type Box, type Point } from './shape';

/** In a larger area (in square pixels) only own lines are added: there is room enough elsewhere. */
const kLarge = 4e6;
/** Free room around everything. */
const kRim = 96;

export class Field {
  /** All that is there, with free room around it. */
  readonly whole: Box;
  private readonly boxes = new Cells<Box>();
  private readonly stubs = new Cells<Point>();

  constructor(boxes: readonly Box[], stubs: readonly Point[]) {
    const { x, y, width, height } = around([
      ...boxes,
      ...stubs.map((one) => ({ ...one, width: 0, height: 0 })),
    ]);
    this.whole = {
      x: x - kRim,
      y: y - kRim,
      width: width + 2 * kRim,
      height: height + 2 * kRim,
    };
    for (const box of boxes) this.boxes.put(box, box);
    for (const stub of stubs) this.stubs.put({ ...stub, width: 0, height: 0 }, stub);
  }

  /** For one search inside of an area; `own` ends of arrows have lines through them in any case. */
  grid(area: Box, own: readonly Point[], clear: number): Grid {
    const isLarge = area.width * area.height > kLarge;
    const others = isLarge ? [] : [...this.stubs.near(area)].filter((one) => holds(area, one));
    return new Grid(area, [...this.boxes.near(area)], [...own, ...others], clear);
  }

  near(area: Box): ReadonlySet<Box> {
    return this.boxes.near(area);
  }
}

function holds({ x, y, width, height }: Box, point: Point): boolean {
  return point.x >= x && point.x <= x + width && point.y >= y && point.y <= y + height;
}

export function meetingOf(a: Box, b: Box): Box {
  const x = Math.max(a.x, b.x);
  const y = Math.max(a.y, b.y);
  const right = Math.min(a.x + a.width, b.x + b.width);
  const bottom = Math.min(a.y + a.height, b.y + b.height);
  return { x, y, width: Math.max(0, right - x), height: Math.max(0, bottom - y) };
}
