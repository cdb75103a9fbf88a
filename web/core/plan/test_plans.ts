// Random plans and what holds of every drawing, for tests.

import type { Json, PlanTemplate, PlanToolbox } from '../../protocol/messages';
import type { Drawing } from './arrows';
import { eachStretch, stretchBox } from './path';
import type { Note, PlanModel } from './model';
import { blocksOf, type Scene } from './place';
import { overlaps, type Box } from './shape';

export function template(
  name: string,
  kind: PlanTemplate['kind'],
  outcomes: string[],
): PlanTemplate {
  const named = outcomes.map((one) => ({ name: one, help: '' }));
  const bare = { help: '', icon: '', inputs: [], outputs: [], period_ms: 10, starts: [] };
  return { name, kind, outcomes: named, ...bare };
}

export const toolboxes: PlanToolbox[] = [
  {
    name: 'core',
    help: '',
    templates: [
      template('Wait', 'actor', ['Done']),
      template('For', 'computation', ['Loop', 'Done']),
      template('Timeout', 'supervisor', ['Timeout']),
      template('Watch', 'supervisor', ['True']),
    ],
  },
  { name: 'drive', help: 'Wheels.', templates: [template('Forward', 'actor', ['There'])] },
];

/** Actors, at most 24 if nobody says how many, with supervisors, some of them placed, none on another one. */
export function randomPlan(random: (below: number) => number, count = 1 + random(24)): Json {
  const target = () => (random(8) === 0 ? '@terminate' : `a${random(count)}`);
  const actors: Record<string, Json> = {};
  const layout: Record<string, Json> = {};
  const isPlaced = random(2) === 0;
  for (let at = 0; at < count; at++) {
    const supervisors: Record<string, Json> = {};
    for (let more = random(3); more > 0; more--)
      supervisors[`s${at}_${more}`] = { template: 'Timeout', events: { Timeout: target() } };
    const states: Record<string, Json> = random(2)
      ? { Done: target() }
      : { Loop: target(), Done: target() };
    actors[`a${at}`] = { template: 'Loop' in states ? 'For' : 'Wait', states, supervisors };
    // Each in a field of its own: 168 wide, 92 and two supervisors of 44 high at most.
    const jitter = [random(9) * 8, random(6) * 8];
    if (isPlaced)
      layout[`a${at}`] = [
        (at % 5) * 320 + (jitter[0] ?? 0),
        Math.floor(at / 5) * 300 + (jitter[1] ?? 0),
      ];
  }
  const configuration = Object.fromEntries(
    Array.from({ length: random(6) }, (_one, at) => [`v${at}`, { type: 'int', initial: at }]),
  );
  return {
    format: 'vagus-plan/1',
    name: 'R',
    start: { actor: 'a0' },
    configuration,
    actors,
    layout,
  };
}

/** Twelve actors in four columns with 8 px between them, and notes among them: as close as the grid permits. */
export function packedPlan(random: (below: number) => number): Json {
  const actors: Record<string, Json> = {};
  const layout: Record<string, Json> = { '@start': [-200, 0] };
  const notes: Json[] = [];
  for (let at = 0; at < 12; at++) {
    const corner = [(at % 4) * 176, Math.floor(at / 4) * 104];
    if (random(4) === 0) notes.push({ at: corner, size: [168, 96], text: '' });
    else layout[`a${at}`] = corner;
  }
  const names = Object.keys(layout).filter((name) => name !== '@start');
  const target = () => names[random(names.length)] ?? '@terminate';
  for (const name of names)
    actors[name] = { template: 'For', states: { Loop: target(), Done: target() } };
  return {
    format: 'vagus-plan/1',
    name: 'R',
    start: { actor: names[0] ?? '' },
    actors,
    layout,
    x: { notes },
  };
}

/** A long program: each actor leads to one near it, and has a supervisor that leads back a little. */
export function longPlan(random: (below: number) => number, count: number): Json {
  const near = (at: number, by: number) => `a${Math.min(count - 1, Math.max(0, at + by))}`;
  const actor = (at: number): Json => ({
    template: 'For',
    states: { Loop: near(at, -random(4)), Done: near(at, 1 + random(3)) },
    supervisors: random(3)
      ? {}
      : { [`s${at}`]: { template: 'Timeout', events: { Timeout: near(at, -random(8)) } } },
  });
  const names = Array.from({ length: count }, (_one, at) => `a${at}`);
  return {
    format: 'vagus-plan/1',
    name: 'R',
    start: { actor: 'a0' },
    actors: Object.fromEntries(names.map((name, at) => [name, actor(at)])),
  };
}

/** Blocks of which one stands on another. */
export function covered(scene: Scene): [Box, Box][] {
  const boxes = blocksOf(scene).map((block) => block.whole);
  return boxes.flatMap((box, index) =>
    boxes
      .slice(index + 1)
      .flatMap((other): [Box, Box][] => (overlaps(box, other) ? [[box, other]] : [])),
  );
}

/** Notes on which an element stands. */
export function coveredNotes({ notes }: PlanModel, scene: Scene): Box[] {
  const boxes = [...blocksOf(scene).map(({ whole }) => whole), ...pillsOf(scene)];
  return notes.map(noteBox).filter((note) => boxes.some((box) => overlaps(box, note)));
}

export function noteBox({ at: [x, y], size: [width, height] }: Note): Box {
  return { x, y, width, height };
}

const pillsOf = (scene: Scene) => scene.pills.map(({ box }) => box);

/** What is wrong with the arrows: each is there, has right angles and runs through no box. */
export function faultsOfArrows(
  scene: Scene,
  drawing: Drawing,
  notes: readonly Note[] = [],
): string[] {
  const boxes = [...boxesOf(scene, drawing), ...notes.map(noteBox)];
  return drawing.arrows.flatMap(({ id }) => {
    const points = drawing.routes.get(id)?.points ?? [];
    const faults = points.length < 2 ? [`${id} is not there`] : [];
    eachStretch(points, (from, to) => {
      if (from.x !== to.x && from.y !== to.y) faults.push(`${id} is not upright`);
      for (const box of boxes)
        if (overlaps(box, stretchBox(from, to)))
          faults.push(`${id} ${JSON.stringify([from, to, box])}`);
    });
    return faults;
  });
}

function boxesOf(scene: Scene, drawing: Drawing): Box[] {
  return [
    ...blocksOf(scene).flatMap((block) => [block.box, ...block.supervisors.map(({ box }) => box)]),
    ...pillsOf(scene),
    ...drawing.tags.map(({ box }) => box),
  ];
}
