// The picture from above: which part of the world is seen, and how large.

import type { Point, Pose } from './geometry';

/** The middle of what is seen, and how many pixels a metre has. */
export interface View extends Point {
  scale: number;
}

export interface Extent {
  width: number;
  height: number;
}

export const kScaleMin = 4;
export const kScaleMax = 8000;
/** Metres that are seen beyond the walls when all is fitted. */
export const kWall = 0.06;

export function fitted(world: Extent, screen: Extent, margin = 10): View {
  const width = world.width + 2 * kWall;
  const height = world.height + 2 * kWall;
  const scale = Math.min(
    Math.max(screen.width - 2 * margin, 40) / width,
    Math.max(screen.height - 2 * margin, 40) / height,
  );
  return { x: world.width / 2, y: world.height / 2, scale: limited(scale) };
}

export function toScreen(view: View, screen: Extent, point: Point): Point {
  return {
    x: screen.width / 2 + (point.x - view.x) * view.scale,
    y: screen.height / 2 - (point.y - view.y) * view.scale,
  };
}

export function toWorld(view: View, screen: Extent, point: Point): Point {
  return {
    x: view.x + (point.x - screen.width / 2) / view.scale,
    y: view.y - (point.y - screen.height / 2) / view.scale,
  };
}

/** The part of the width, at the right, in which something at that side may cover what is there. */
const kSide = 0.45;
/** Nearer to the middle than this part of the height it stays where it is. */
const kMiddle = 0.05;

/** Whether something at the right is better low than high, for what is at that point of the screen to be seen. */
export function isBetterLow({ width, height }: Extent, { x, y }: Point, isLow: boolean): boolean {
  if (!(x > width * (1 - kSide))) return isLow;
  if (y < height * (0.5 - kMiddle)) return true;
  return y > height * (0.5 + kMiddle) ? false : isLow;
}

/** Larger or smaller by a factor; what is under the point stays there. */
export function zoomed(view: View, screen: Extent, at: Point, factor: number): View {
  const scale = limited(view.scale * factor);
  const there = toWorld(view, screen, at);
  const part = view.scale / scale;
  return {
    x: there.x + (view.x - there.x) * part,
    y: there.y + (view.y - there.y) * part,
    scale,
  };
}

export function panned(view: View, by: Point): View {
  return { ...view, x: view.x - by.x / view.scale, y: view.y + by.y / view.scale };
}

/** The distance of grid lines: 1, 2 or 5 times a power of ten metres, at least so many pixels. */
export function gridStep(scale: number, least = 24): number {
  const wanted = least / scale;
  const power = 10 ** Math.floor(Math.log10(wanted));
  for (const factor of [1, 2, 5, 10]) if (power * factor >= wanted * 0.999) return power * factor;
  return power * 10;
}

/** "50 cm", "2 m", "5 mm": a length as people say it. */
export function lengthText(metres: number): string {
  if (metres >= 1) return `${round(metres)} m`;
  return metres >= 0.01 ? `${round(metres * 100)} cm` : `${round(metres * 1000)} mm`;
}

/** Where the handle that turns a thing is: ahead of it, clear of its body. */
export function handleOf(pose: Pose, reach: number, scale: number): Point {
  const away = reach + 22 / scale;
  return { x: pose.x + Math.cos(pose.angle) * away, y: pose.y + Math.sin(pose.angle) * away };
}

function limited(scale: number): number {
  return Math.min(kScaleMax, Math.max(kScaleMin, scale));
}

function round(value: number): number {
  return Number(value.toPrecision(4));
}
