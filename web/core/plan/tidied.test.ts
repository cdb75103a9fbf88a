// Random plans after Tidy, drawn as on the canvas, and their geometry measured.
import ELK from 'elkjs/lib/elk.bundled.js';
import { describe, expect, it } from 'vitest';
import type { Json } from '../../protocol/messages';
import { seeded } from '../test_seeded';
import { drawingOf } from './arrows';
import { kConfiguration, kStart, planModel } from './model';
import type { Point } from './shape';
import { noteIndex } from './notes';
import { sceneOf } from './place';
import {
  covered,
  coveredNotes,
  faultsOfArrows,
  longPlan,
  randomPlan,
  toolboxes,
} from './test_plans';
import { besideNotes, besideVariables, elkGraph, inColumns, layoutGraph, tidied } from './tidy';

async function tidy(value: { [key: string]: Json }) {
  const model = planModel(value, toolboxes);
  const all = new Set([kStart, ...model.actors.map(({ name }) => name)]);
  const graph = layoutGraph(model, sceneOf(model), all);
  const laid = await new ELK().layout(elkGraph(graph));
  const places = new Map(
    (laid.children ?? []).map(({ id, x, y }) => [id, { x: x ?? 0, y: y ?? 0 }]),
  );
  return placed(value, besideNotes(model, besideVariables(model, tidied(graph, places))));
}

/** The plan with what it has at these places. */
function placed(value: { [key: string]: Json }, places: readonly [string, Point][]) {
  const layout = { ...(value['layout'] as { [key: string]: Json }) };
  const notes = planModel(value, toolboxes).notes.map(({ at, size, text }) => ({ at, size, text }));
  for (const [key, { x, y }] of places) {
    const note = notes[noteIndex(key) ?? -1];
    if (note) note.at = [x, y];
    else layout[key] = [x, y];
  }
  return planModel({ ...value, layout, x: { notes } as unknown as Json }, toolboxes);
}

async function expectTidied(name: string, value: Json): Promise<void> {
  const model = await tidy(value as { [key: string]: Json });
  const scene = sceneOf(model);
  expect(covered(scene), name).toEqual([]);
  expect(coveredNotes(model, scene), name).toEqual([]);
  expect(faultsOfArrows(scene, drawingOf(model, scene), model.notes), name).toEqual([]);
}

describe('a tidied plan', () => {
  it('has no box on another, and no arrow through a box: 50 random plans', async () => {
    const seed = Number(process.env['VAGUS_SEED'] ?? Math.floor(Math.random() * 2 ** 31));
    console.info(`seed ${seed}`);
    const random = seeded(seed);
    for (let plan = 0; plan < 50; plan++) {
      const value = randomPlan(random) as { [key: string]: Json };
      const layout = value['layout'] as { [key: string]: Json };
      // The variables were placed by hand where elements are put.
      if (random(2)) layout[kConfiguration] = [80 + random(400), 80 + random(400)];
      // Notes that were written where elements come to stand.
      const notes = Array.from({ length: random(4) }, (_one, at) => ({
        at: [80 + random(120) * 8, 80 + random(80) * 8],
        size: [192, 72],
        text: `note ${at}`,
      }));
      value['x'] = { notes };
      await expectTidied(`seed ${seed}, plan ${plan}`, value);
    }
  }, 300_000);

  it('may have 500 actors: in columns, if the layout takes too long, with all its arrows', () => {
    const value = longPlan(seeded(1), 500) as { [key: string]: Json };
    const places = inColumns(planModel(value, toolboxes));
    expect(places.length).toBe(501);
    const model = placed(value, places);
    const scene = sceneOf(model);
    expect(covered(scene)).toEqual([]);
    expect(faultsOfArrows(scene, drawingOf(model, scene))).toEqual([]);
  }, 300_000);
});
