// Where elements are: where the file says, else where there is room. What the user placed stays.

import { kConfiguration, kStart, type Actor, type PlanModel } from './model';
import {
  actorBlock,
  around,
  blockAt,
  kPill,
  kStartSize,
  overlaps,
  pillBoxes,
  type Block,
  type Box,
  type Point,
} from './shape';

export type Places = ReadonlyMap<string, readonly [number, number]>;

export interface Scene {
  start: Block;
  actors: readonly Block[];
  pills: readonly { name: string; box: Box }[];
  configuration: Point;
}

/** All that takes room of its own and has supervisors below it: the start and each actor. */
export const blocksOf = (scene: Scene): readonly Block[] => [scene.start, ...scene.actors];

const kColumn = 240;
const kGap = 48;
const kFirst: Point = { x: 80, y: 80 };
/** Positions snap to this when they are dragged. */
export const kSnap = 8;

export const snapped = (value: number) => Math.round(value / kSnap) * kSnap;

/**
 * What has a place in the file is there; the rest where it was `before`, if it did and nothing covers it now:
 * nothing moves because something else was dropped or deleted.
 */
export function sceneOf(file: PlanModel, before: Places = new Map()): Scene {
  const model = before.size === 0 ? file : { ...file, places: uncovered(file, before) };
  const actors = placeActors(model);
  const startAt = placeOf(model, kStart) ?? freePlaceForStart(model, actors);
  const start = blockAt(kStart, startAt, kStartSize, model.globals);
  const blocks = [...actors, start];
  const kept = placeOf(model, kConfiguration);
  const isFree =
    kept !== undefined && (file.places.has(kConfiguration) || fits(model, kept, blocks));
  const configuration = isFree ? kept : aboveAll(blocks, model);
  return { start, actors, configuration, pills: pillBoxes(model, configuration) };
}

/** Of places that were found before only those where an element still has room: it or its neighbour may have grown. */
function uncovered(file: PlanModel, before: Places): Places {
  const places = new Map(file.places);
  const taken: Block[] = [];
  const blocks = [
    ...file.actors.map((actor) => ({ name: actor.name, at: (to: Point) => actorBlock(actor, to) })),
    { name: kStart, at: (to: Point) => blockAt(kStart, to, kStartSize, file.globals) },
  ];
  for (const { name, at } of blocks) {
    const place = placeOf(file, name);
    if (place) taken.push(at(place));
  }
  for (const { name, at } of blocks) {
    const known = before.get(name);
    if (!known || places.has(name)) continue;
    const block = at({ x: known[0], y: known[1] });
    if (taken.some((one) => overlaps(one.whole, block.whole))) continue;
    taken.push(block);
    places.set(name, known);
  }
  const pills = before.get(kConfiguration);
  if (pills && !places.has(kConfiguration)) places.set(kConfiguration, pills);
  return places;
}

function fits(model: PlanModel, at: Point, blocks: readonly Block[]): boolean {
  return !pillBoxes(model, at).some(({ box }) => blocks.some(({ whole }) => overlaps(whole, box)));
}

/** Where those are that have no place in the file, beside what was known of them before. */
export function found(file: PlanModel, scene: Scene, before: Places): Places {
  const known = new Map(before);
  const keep = (name: string, { x, y }: Point) => {
    if (!file.places.has(name)) known.set(name, [x, y]);
  };
  for (const { name, box } of scene.actors) keep(name, box);
  // An empty drawing has no places yet: Start is where the first actor wants it.
  if (scene.actors.length > 0) keep(kStart, scene.start.box);
  if (scene.actors.length > 0 && scene.pills.length > 0) keep(kConfiguration, scene.configuration);
  return known;
}

function placeOf(model: PlanModel, name: string): Point | undefined {
  const at = model.places.get(name);
  return at && { x: at[0], y: at[1] };
}

/** Those without a place are in columns, by how many arrows lead to them from the start. */
function placeActors(model: PlanModel): Block[] {
  const known = new Map<string, Block>();
  for (const actor of model.actors) {
    const at = placeOf(model, actor.name);
    if (at) known.set(actor.name, actorBlock(actor, at));
  }
  const left = model.actors.filter((actor) => !known.has(actor.name));
  const taken = around([...known.values()].map((block) => block.whole));
  const top = known.size > 0 ? taken.y + taken.height + kGap : kFirst.y + startHeight(model) + kGap;
  const corner = { x: known.size > 0 ? taken.x : kFirst.x, y: top };
  for (const block of inColumns(left, ranks(model), corner)) known.set(block.name, block);
  return model.actors.flatMap((actor) => known.get(actor.name) ?? []);
}

function startHeight(model: PlanModel): number {
  return blockAt(kStart, kFirst, kStartSize, model.globals).whole.height;
}

function inColumns(
  actors: readonly Actor[],
  rankOf: ReadonlyMap<string, number>,
  corner: Point,
): Block[] {
  const columns = new Map<number, Actor[]>();
  for (const actor of actors) {
    const rank = rankOf.get(actor.name) ?? 0;
    columns.set(rank, [...(columns.get(rank) ?? []), actor]);
  }
  const ordered = [...columns].sort(([a], [b]) => a - b).map(([, column]) => column);
  return ordered.flatMap((column, index) => {
    let y = corner.y;
    return column.map((actor) => {
      const block = actorBlock(actor, { x: corner.x + index * kColumn, y });
      y = snapped(y + block.whole.height + kGap);
      return block;
    });
  });
}

/** How many arrows from the start, or after all that can be reached. */
function ranks(model: PlanModel): Map<string, number> {
  const found = new Map<string, number>();
  const next = new Map(model.actors.map((actor) => [actor.name, targetsOf(actor)]));
  const roots = [
    ...(model.first === null ? [] : [model.first]),
    ...model.globals.flatMap((one) => one.outcomes.flatMap(({ target }) => target ?? [])),
    ...model.actors.map((actor) => actor.name),
  ];
  for (const root of roots) {
    if (!next.has(root) || found.has(root)) continue;
    spread(root, next, found);
  }
  return found;
}

function spread(
  root: string,
  next: ReadonlyMap<string, readonly string[]>,
  found: Map<string, number>,
): void {
  found.set(root, 0);
  const queue = [root];
  for (let name = queue.shift(); name !== undefined; name = queue.shift())
    for (const target of next.get(name) ?? []) {
      if (!next.has(target) || found.has(target)) continue;
      found.set(target, (found.get(name) ?? 0) + 1);
      queue.push(target);
    }
}

function targetsOf(actor: Actor): string[] {
  const outcomes = [actor, ...actor.supervisors].flatMap((one) => one.outcomes);
  return outcomes.flatMap(({ target }) => target ?? []);
}

/** Above the first actor, else left of it, else above everything. */
function freePlaceForStart(model: PlanModel, actors: readonly Block[]): Point {
  const first = actors.find((block) => block.name === model.first) ?? actors[0];
  if (!first) return kFirst;
  const height = startHeight(model);
  const all = around(actors.map((block) => block.whole));
  const { x, y } = first.box;
  const places: Point[] = [
    { x, y: y - height - kGap },
    { x: x - kColumn, y },
    { x, y: all.y - height - kGap },
  ];
  const fits = (at: Point) => {
    const { whole } = blockAt(kStart, at, kStartSize, model.globals);
    return !actors.some((block) => overlaps(block.whole, whole, kGap / 2));
  };
  return places.find(fits) ?? places[2] ?? kFirst;
}

function aboveAll(blocks: readonly Block[], model: PlanModel): Point {
  const { x, y } = around(blocks.map((block) => block.whole));
  const boxes = pillBoxes(model, { x: 0, y: 0 }).map(({ box }) => box);
  return { x, y: y - around(boxes).height - kPill.height - kGap };
}

const kOfNew = { width: 168, height: 92 };
/** How many columns of boxes to each side are looked through. */
const kColumnsMax = 8;

/**
 * As `freePlace`, where all of the element can be seen: below the point or in a column beside it, else the nearest
 * place in sight; where there is no room, as there.
 */
export function freePlaceIn(room: Box, scene: Scene, wanted: Point): Point {
  const isIn = ({ x, y }: Point) =>
    x >= room.x &&
    y >= room.y &&
    x + kOfNew.width <= room.x + room.width &&
    y + kOfNew.height <= room.y + room.height;
  const columns = Array.from({ length: 2 * kColumnsMax + 1 }, (_one, at) =>
    at % 2 === 0 ? -at / 2 : (at + 1) / 2,
  );
  const places = columns.map((column) =>
    freePlace(scene, { ...wanted, x: wanted.x + column * (kOfNew.width + kGap) }),
  );
  return places.find(isIn) ?? nearestIn(room, scene, wanted) ?? freePlace(scene, wanted);
}

/** Where an element was dropped; where it would cover something there, the nearest place in sight. */
export function dropPlace(room: Box, scene: Scene, wanted: Point): Point {
  const below = freePlace(scene, wanted);
  return below.y === snapped(wanted.y) ? below : (nearestIn(room, scene, wanted) ?? below);
}

const kGrid = 3 * kSnap;

function nearestIn(room: Box, scene: Scene, wanted: Point): Point | undefined {
  const boxes = boxesOf(scene);
  const steps = (from: number, length: number) => {
    const first = Math.ceil(from / kGrid);
    const last = Math.floor((from + length) / kGrid);
    return Array.from(
      { length: Math.max(0, last - first + 1) },
      (_one, at) => (first + at) * kGrid,
    );
  };
  const xs = steps(room.x, room.width - kOfNew.width);
  const ys = steps(room.y, room.height - kOfNew.height);
  const far = ({ x, y }: Point) => Math.hypot(x - wanted.x, y - wanted.y);
  return xs
    .flatMap((x) => ys.map((y) => ({ x, y })))
    .filter((at) => !boxes.some((box) => overlaps(box, { ...at, ...kOfNew }, kGap / 2)))
    .reduce<Point | undefined>((best, at) => (best && far(best) <= far(at) ? best : at), undefined);
}

function boxesOf(scene: Scene): Box[] {
  const blocks = blocksOf(scene).map((block) => block.whole);
  return [...blocks, ...scene.pills.map((pill) => pill.box)];
}

/** The nearest place at or below a point where an element of that size covers nothing. */
export function freePlace(scene: Scene, wanted: Point, size = kOfNew): Point {
  const boxes = boxesOf(scene);
  const at = { x: snapped(wanted.x), y: snapped(wanted.y) };
  for (let tries = 0; tries <= boxes.length; tries++) {
    const inTheWay = boxes.find((box) => overlaps(box, { ...at, ...size }, kGap / 2));
    if (!inTheWay) break;
    at.y = snapped(inTheWay.y + inTheWay.height + kGap);
  }
  return at;
}
