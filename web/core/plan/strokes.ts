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

/** How large a name is drawn, and what it must not cover. */
export interface NameRoom {
  size: { width: number; height: number };
  boxes: readonly Box[];
}

/**
 * Where the middle of an arrow's name is: in the middle of its longest stretch, or, where the name would cover a
 * box there, on another stretch or beside one. Where it covers something everywhere, it is where that is least.
 */
export function nameSpot({ points }: Routed, room?: NameRoom): Point | null {
  const stretches = points
    .slice(1)
    .map((to, at) => ({ from: points[at] ?? to, to }))
    .filter(({ from, to }) => lengthOf(from, to) > 0)
    .sort((a, b) => lengthOf(b.from, b.to) - lengthOf(a.from, a.to));
  const middles = stretches.map(({ from, to }) => ({
    x: (from.x + to.x) / 2,
    y: (from.y + to.y) / 2,
  }));
  const longest = middles[0] ?? null;
  const [begin] = points;
  if (!room || !longest || !begin) return longest;
  const { width, height } = room.size;
  const covers = ({ x, y }: Point) => {
    const name = { x: x - width / 2, y: y - height / 2, width, height };
    return room.boxes.reduce((sum, box) => sum + sharedArea(box, name), 0);
  };
  const places = middles.flatMap((middle) => [middle, ...sidesOf(middle, room.size)]);
  // An arrow that is shorter than its name has room behind its begin, or above and below the boxes that it joins.
  places.push(...cornersOf(begin, room.size), ...furtherFrom(longest, room.size));
  const areas = places.map(covers);
  return places[areas.indexOf(Math.min(...areas))] ?? longest;
}

function sharedArea(a: Box, b: Box): number {
  const across = Math.min(a.x + a.width, b.x + b.width) - Math.max(a.x, b.x);
  const down = Math.min(a.y + a.height, b.y + b.height) - Math.max(a.y, b.y);
  return Math.max(0, across) * Math.max(0, down);
}

const kBeside = 6;
/** Half heights of a name; further away nobody sees which arrow it belongs to. */
const kFurtherMax = 4;

const lengthOf = (from: Point, to: Point) => Math.hypot(to.x - from.x, to.y - from.y);

/** Above and below a point, to its right and left. */
function sidesOf({ x, y }: Point, { width, height }: NameRoom['size']): Point[] {
  const [across, down] = [width / 2 + kBeside, height / 2 + kBeside];
  return [
    { x, y: y - down },
    { x, y: y + down },
    { x: x + across, y },
    { x: x - across, y },
  ];
}

/** Further and further above and below a point. */
function furtherFrom({ x, y }: Point, { height }: NameRoom['size']): Point[] {
  return Array.from({ length: kFurtherMax }, (_, at) => (at + 2) * (height / 2) + kBeside).flatMap(
    (down) => [
      { x, y: y - down },
      { x, y: y + down },
    ],
  );
}

/** Right and left of a point, above and below it. */
function cornersOf({ x, y }: Point, { width, height }: NameRoom['size']): Point[] {
  const [across, down] = [width / 2 + kBeside, height / 2 + kBeside];
  return [
    { x: x + across, y: y - down },
    { x: x + across, y: y + down },
    { x: x - across, y: y - down },
    { x: x - across, y: y + down },
  ];
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
