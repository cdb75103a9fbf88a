// Which elements are to be placed again, and the graph of them for a layout: each actor with its
// supervisors is one box, arrows lead from left to right.

import { kConfiguration, kStart, type PlanModel } from './model';
import { noteKey } from './notes';
import { blocksOf, sceneOf, snapped, type Scene } from './place';
import { overlaps, type Block, type Box, type Point } from './shape';

export interface LayoutGraph {
  boxes: { id: string; width: number; height: number }[];
  edges: { from: string; to: string }[];
  /** Their upper left corner, where they were or where there is room. */
  corner: Point;
}

/** Several that are chosen; else those that nobody has placed; else all. */
export function toTidy(model: PlanModel, chosen: ReadonlySet<string>): ReadonlySet<string> {
  const all = model.actors.map((one) => one.name);
  if (chosen.size > 1) return chosen;
  const unplaced = all.filter((name) => !model.places.has(name));
  return new Set(unplaced.length > 0 && unplaced.length < all.length ? unplaced : [kStart, ...all]);
}

export function layoutGraph(
  model: PlanModel,
  scene: Scene,
  wanted: ReadonlySet<string>,
): LayoutGraph {
  const blocks = blocksOf(scene);
  const moved = blocks.filter((block) => wanted.has(block.name));
  return {
    boxes: moved.map(({ name, whole }) => ({ id: name, ...sizeOf(whole) })),
    edges: edgesOf(model).filter(({ from, to }) => wanted.has(from) && wanted.has(to)),
    corner: cornerOf(blocks, moved),
  };
}

const sizeOf = ({ width, height }: { width: number; height: number }) => ({ width, height });

function edgesOf(model: PlanModel): { from: string; to: string }[] {
  const led = (from: string, outcomes: readonly { target: string | null }[]) =>
    outcomes.flatMap(({ target }) =>
      target === null || target.startsWith('@') ? [] : [{ from, to: target }],
    );
  return [
    ...led(kStart, [{ target: model.first }]),
    ...model.globals.flatMap((one) => led(kStart, one.outcomes)),
    ...model.actors.flatMap((actor) =>
      [actor, ...actor.supervisors].flatMap((one) => led(actor.name, one.outcomes)),
    ),
  ];
}

/** How ELK lays it out. */
const kElkOptions = {
  'elk.algorithm': 'layered',
  'elk.direction': 'RIGHT',
  'elk.edgeRouting': 'ORTHOGONAL',
  // Between columns and rows: room for the lanes of arrows.
  'elk.layered.spacing.nodeNodeBetweenLayers': '88',
  'elk.spacing.nodeNode': '56',
  'elk.spacing.componentComponent': '64',
  'elk.layered.considerModelOrder.strategy': 'NODES_AND_EDGES',
};

/** The graph as ELK takes it. */
export function elkGraph({ boxes, edges }: LayoutGraph) {
  return {
    id: 'plan',
    layoutOptions: kElkOptions,
    children: boxes.map((one) => ({ ...one })),
    edges: edges.map(({ from, to }, index) => ({
      id: String(index),
      sources: [from],
      targets: [to],
    })),
  };
}

const kGap = 48;
/** Room for arrows between a note and an element. */
const kNoteGap = 24;

/** Where the first of them are; below all others if those are in the way. */
function cornerOf(blocks: readonly Block[], moved: readonly Block[]): Point {
  const kept = blocks.filter((block) => !moved.includes(block));
  const x = Math.min(...moved.map(({ whole }) => whole.x));
  const y = Math.min(...moved.map(({ whole }) => whole.y));
  if (kept.length === 0) return { x, y };
  const below = Math.max(...kept.map(({ whole }) => whole.y + whole.height)) + kGap;
  return { x, y: snapped(below) };
}

/**
 * Where they are if nobody has placed any: in columns, by how many arrows lead to them from the start. For plans of
 * which a layout would take minutes.
 */
export function inColumns(model: PlanModel): [string, Point][] {
  const { start, actors } = sceneOf({ ...model, places: new Map() });
  return [start, ...actors].map(({ name, box: { x, y } }) => [name, { x, y }]);
}

/** With a place above all for the variables, if elements would be on them or close to them. */
export function besideVariables(
  model: PlanModel,
  places: readonly [string, Point][],
): [string, Point][] {
  const after = new Map(model.places);
  for (const [name, { x, y }] of places) after.set(name, [x, y]);
  const { start, actors, pills } = sceneOf({ ...model, places: after });
  const isFree = [start, ...actors].every(({ whole }) =>
    pills.every(({ box }) => !overlaps(whole, box, kGap / 2)),
  );
  if (isFree) return [...places];
  after.delete(kConfiguration);
  const above = sceneOf({ ...model, places: after }).configuration;
  const on = { x: snapped(above.x), y: snapped(above.y) };
  return [...places, [kConfiguration, on]];
}

/** With places for the notes on which elements would stand: below those, where they cover nothing. */
export function besideNotes(
  model: PlanModel,
  places: readonly [string, Point][],
): [string, Point][] {
  const after = new Map(model.places);
  for (const [name, { x, y }] of places) after.set(name, [x, y]);
  const { start, actors, pills } = sceneOf({ ...model, places: after });
  const taken = [...[start, ...actors].map(({ whole }) => whole), ...pills.map(({ box }) => box)];
  const onto = (box: Box) => taken.find((one) => overlaps(one, box, kNoteGap));
  const notes = model.notes.map(({ index, at: [x, y], size: [width, height] }) => ({
    key: noteKey(index),
    box: { x, y, width, height },
  }));
  const covered = notes.filter(({ box }) => onto(box));
  taken.push(...notes.filter((one) => !covered.includes(one)).map(({ box }) => box));
  const moved = covered.map(({ key, box }): [string, Point] => {
    const free = { ...box, x: snapped(box.x), y: snapped(box.y) };
    for (let other = onto(free); other; other = onto(free))
      free.y = snapped(other.y + other.height + kGap);
    taken.push(free);
    return [key, { x: free.x, y: free.y }];
  });
  return [...places, ...moved];
}

/** Places on the grid, as a layout gave them. */
export function tidied(graph: LayoutGraph, places: ReadonlyMap<string, Point>): [string, Point][] {
  return [...places].map(([name, { x, y }]) => [
    name,
    { x: snapped(graph.corner.x + x), y: snapped(graph.corner.y + y) },
  ]);
}
