// Ways as SVG paths: rounded corners, and where one way crosses another.

import { Cells } from './cells';
import type { Box, Point } from './shape';

/** The way of an arrow. */
export interface Routed {
  id: string;
  points: readonly Point[];
}

export const kCorner = 8;

export function roundedPath(points: readonly Point[], radius = kCorner): string {
  const [first, ...rest] = points;
  if (!first) return '';
  let path = `M${at(first)}`;
  rest.forEach((point, index) => {
    const before = points[index];
    const after = rest[index + 1];
    if (!before || !after) path += `L${at(point)}`;
    else path += corner(before, point, after, radius);
  });
  return path;
}

/** The same without its corners rounded. */
export function straightPath(points: readonly Point[]): string {
  return points.map((point, index) => `${index === 0 ? 'M' : 'L'}${at(point)}`).join('');
}

/** A corner never takes more than half of what it joins. */
function corner(before: Point, point: Point, after: Point, radius: number): string {
  const room = Math.min(distance(before, point), distance(point, after)) / 2;
  const by = Math.min(radius, room);
  return `L${at(toward(point, before, by))}Q${at(point)} ${at(toward(point, after, by))}`;
}

function toward(from: Point, to: Point, by: number): Point {
  const far = distance(from, to) || 1;
  return { x: from.x + ((to.x - from.x) / far) * by, y: from.y + ((to.y - from.y) / far) * by };
}

function distance(a: Point, b: Point): number {
  return Math.abs(a.x - b.x) + Math.abs(a.y - b.y);
}

function at({ x, y }: Point): string {
  return `${tidy(x)} ${tidy(y)}`;
}

const tidy = (value: number) => Math.round(value * 100) / 100;

export interface Crossing extends Point {
  /** The way of the upper arrow there. */
  isLevel: boolean;
}

/** Where an arrow crosses those before it, by its id: the lower one gets a gap there. */
export function crossings(
  routes: readonly Routed[],
  aimOf: (id: string) => string,
): Map<string, Crossing[]> {
  const found = new Map<string, Crossing[]>();
  const drawn = new Cells<Stretch>();
  for (const { id, points } of routes) {
    const aim = aimOf(id);
    const own: Stretch[] = [];
    const met: Crossing[] = [];
    eachStretch(points, (from, to) => {
      own.push({ aim, from, to });
      for (const lower of drawn.near(stretchBox(from, to))) {
        const point = lower.aim === aim ? null : crossingOf(from, to, lower.from, lower.to);
        if (point) met.push({ ...point, isLevel: from.y === to.y });
      }
    });
    for (const one of own) drawn.put(stretchBox(one.from, one.to), one);
    if (met.length > 0) found.set(id, met);
  }
  return found;
}

interface Stretch {
  aim: string;
  from: Point;
  to: Point;
}

export function stretchBox(a: Point, b: Point): Box {
  const x = Math.min(a.x, b.x);
  const y = Math.min(a.y, b.y);
  return { x, y, width: Math.abs(a.x - b.x), height: Math.abs(a.y - b.y) };
}

function crossingOf(a: Point, b: Point, c: Point, d: Point): Point | null {
  const isLevel = a.y === b.y;
  if (isLevel === (c.y === d.y)) return null;
  const [h, k, v, w] = isLevel ? [a, b, c, d] : [c, d, a, b];
  const inside = between(v.x, h.x, k.x) && between(h.y, v.y, w.y);
  return inside ? { x: v.x, y: h.y } : null;
}

function between(value: number, a: number, b: number): boolean {
  return value > Math.min(a, b) && value < Math.max(a, b);
}

export function eachStretch(points: readonly Point[], act: (from: Point, to: Point) => void): void {
  points.slice(1).forEach((to, index) => {
    const from = points[index];
    if (from) act(from, to);
  });
}
