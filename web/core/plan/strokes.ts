// The lines of a drawing as paths: action arrows up to their heads, the gaps where they cross, data
// arrows. The canvas and the exported picture draw the same.

import type { Drawing } from './arrows';
import type { DataArrow } from './data';
import { crossings, type Crossing, type Routed } from './path';
import type { Box, Point } from './shape';

/** Events interrupt: their arrows are dashed; look/draw.css says the same. */
export const kEventDash = '9 5';

const kHead = 9;

/** The line ends where the head begins. */
export function shortened({ points }: Routed): readonly Point[] {
  const last = points.at(-1);
  const before = points.at(-2);
  if (!last || !before) return points;
  const x = last.x - Math.sign(last.x - before.x) * kHead;
  const y = last.y - Math.sign(last.y - before.y) * kHead;
  return [...points.slice(0, -1), { x, y }];
}

/** Where the name of an arrow is: in the middle of its longest stretch. */
export function nameSpot({ points }: Routed): Point | null {
  let spot: Point | null = null;
  let longest = 0;
  points.forEach((to, index) => {
    const from = points[index - 1];
    const length = from ? Math.hypot(to.x - from.x, to.y - from.y) : 0;
    if (!from || length <= longest) return;
    longest = length;
    spot = { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 };
  });
  return spot;
}

export function gapsOf(drawing: Drawing): Map<string, Crossing[]> {
  const aims = new Map(drawing.arrows.map(({ id, target }) => [id, target]));
  const routes = drawing.arrows.flatMap(({ id }) => drawing.routes.get(id) ?? []);
  return crossings(routes, (id) => aims.get(id) ?? id);
}

/** Wider than the arrow, across it. */
export function gapPath({ x, y, isLevel }: Crossing): string {
  return isLevel ? `M${x - 6} ${y}h12` : `M${x} ${y - 6}v12`;
}

const kApart = 22;

/** From a variable to an element or back; several of one element are apart. */
export function dataPath(
  arrow: DataArrow,
  box: Box,
  pill: Box,
  index: number,
): { line: string; head: string } {
  const at = { x: box.x + 14 + ((index * kApart) % (box.width - 28)), y: box.y };
  const from = { x: pill.x + 24 + ((index * 9) % (pill.width - 48)), y: pill.y + pill.height };
  const middle = (from.y + at.y) / 2;
  const isIn = arrow.is === 'in';
  const end = isIn ? at : from;
  const by = isIn ? -5 : 5;
  return {
    line: `M${from.x} ${from.y}C${from.x} ${middle} ${at.x} ${middle} ${at.x} ${at.y}`,
    head: `M${end.x - 3} ${end.y + by}l3 ${-by}l3 ${by}`,
  };
}
