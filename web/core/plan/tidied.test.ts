// Random plans after Tidy, drawn as on the canvas, and their geometry measured.
import ELK from 'elkjs/lib/elk.bundled.js';
import { describe, expect, it } from 'vitest';
import type { Json } from '../../protocol/messages';
import { seeded } from '../test_seeded';
import { drawingOf } from './arrows';
import { kConfiguration, kStart, planModel } from './model';
import { sceneOf } from './place';
import { covered, faultsOfArrows, randomPlan, toolboxes } from './test_plans';
import { besideVariables, elkGraph, inColumns, layoutGraph, tidied } from './tidy';

async function tidy(value: { [key: string]: Json }) {
  const model = planModel(value, toolboxes);
  const all = new Set([kStart, ...model.actors.map(({ name }) => name)]);
  const graph = layoutGraph(model, sceneOf(model), all);
  const laid = await new ELK().layout(elkGraph(graph));
  const places = new Map(
    (laid.children ?? []).map(({ id, x, y }) => [id, { x: x ?? 0, y: y ?? 0 }]),
  );
  const after = besideVariables(model, tidied(graph, places));
  const layout = Object.fromEntries(after.map(([name, { x, y }]) => [name, [x, y]]));
  const before = value['layout'] as { [key: string]: Json };
  return planModel({ ...value, layout: { ...before, ...layout } }, toolboxes);
}

async function expectTidied(name: string, value: Json): Promise<void> {
  const model = await tidy(value as { [key: string]: Json });
  const scene = sceneOf(model);
  expect(covered(scene), name).toEqual([]);
  expect(faultsOfArrows(scene, drawingOf(model, scene)), name).toEqual([]);
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
      await expectTidied(`seed ${seed}, plan ${plan}`, value);
    }
  }, 300_000);

  it('may have 500 actors: in columns, if the layout takes too long', () => {
    const value = randomPlan(seeded(1), 500) as { [key: string]: Json };
    const places = inColumns(planModel(value, toolboxes));
    expect(places.length).toBe(501);
    const layout = Object.fromEntries(places.map(([name, { x, y }]) => [name, [x, y]]));
    expect(covered(sceneOf(planModel({ ...value, layout }, toolboxes)))).toEqual([]);
  });
});
