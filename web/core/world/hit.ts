// What is under the pointer.

import { distance, distanceTo, reachOf, seenFrom, type Point, type Pose } from './geometry';
import type { Thing } from './stage';

export interface Standing {
  thing: Thing;
  pose: Pose;
}

/**
 * The thing at a place: what lies higher wins, robots over all; of the ground only if nothing is
 * there. slack: metres beside a thing that still count.
 */
export function thingAt(
  things: readonly Standing[],
  point: Point,
  slack: number,
): Standing | undefined {
  let best: Standing | undefined;
  let bestMiss = Infinity;
  for (const one of things) {
    const miss = distanceTo(one.thing.shape, seenFrom(point, one.pose));
    if (!(miss <= slack)) continue;
    // Of two that are met, the one above; of two that are only near, the nearer.
    if (miss < bestMiss || (miss === bestMiss && rank(one.thing) >= rank(best?.thing)))
      [best, bestMiss] = [one, miss];
  }
  return best;
}

export interface Ray {
  from: Point & { z: number };
  /** Its length does not matter. */
  way: Point & { z: number };
}

const kSlices = 24;

/** The thing that a look from above meets first, and where the look meets the ground. */
export function thingOnRay(
  things: readonly Standing[],
  ray: Ray,
  slack: number,
): { hit: Standing | undefined; ground: Point | null } {
  if (ray.way.z >= -1e-6) return { hit: undefined, ground: null };
  const at = (z: number): Point => {
    const part = (z - ray.from.z) / ray.way.z;
    return { x: ray.from.x + ray.way.x * part, y: ray.from.y + ray.way.y * part };
  };
  const top = Math.min(
    ray.from.z,
    things.reduce((most, one) => Math.max(most, one.thing.height), 0),
  );
  for (let slice = kSlices; slice >= 0; slice--) {
    const z = (top * slice) / kSlices;
    const there = things.filter((one) => one.thing.height >= z - 1e-9 || slice === 0);
    const hit = thingAt(there, at(z), slack);
    if (hit) return { hit, ground: at(0) };
  }
  return { hit: undefined, ground: at(0) };
}

export function isOnHandle(handle: Point, point: Point, slack: number): boolean {
  return distance(handle, point) <= slack;
}

/** Things from the ground up, as they are drawn. */
export function drawOrder(things: readonly Standing[]): Standing[] {
  return [...things].sort((a, b) => layer(a.thing) - layer(b.thing));
}

export function isNear(standing: Standing, point: Point): boolean {
  return distance(standing.pose, point) <= reachOf(standing.thing.shape);
}

function rank(thing: Thing | undefined): number {
  return thing ? layer(thing) : -1;
}

function layer(thing: Thing): number {
  switch (thing.kind) {
    case 'patch':
      return 0;
    case 'robot':
      return 3;
    case 'light':
    case 'infrared':
      return 2;
    case 'wall':
    case 'box':
    case 'cylinder':
      return 1;
  }
}
