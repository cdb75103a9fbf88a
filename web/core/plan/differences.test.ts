import { expect, test } from 'vitest';
import type { Json, PlanDifference } from '../../protocol/messages';
import { seeded } from '../test_seeded';
import { drawingOf } from './arrows';
import { marksIn, marksOf, removedIn } from './differences';
import { ghostsOf } from './ghosts';
import { planModel } from './model';
import { sceneOf } from './place';
import { overlaps } from './shape';
import { randomPlan, toolboxes } from './test_plans';

const one = (
  kind: PlanDifference['kind'],
  path: string[],
  values: { before?: Json; after?: Json } = {},
): PlanDifference => ({ kind, element: '', part: '', path, ...values });

test('each difference marks the element or arrow that it is about', () => {
  const marks = (difference: PlanDifference) =>
    marksOf(difference).map(({ key, kind }) => `${kind} ${key}`);
  expect(marks(one('changed', ['actors', 'a', 'in', 'x'], {}))).toEqual(['changed a']);
  expect(marks(one('added', ['actors', 'a', 'in', 'x'], { after: 3 }))).toEqual(['changed a']);
  expect(marks(one('removed', ['actors', 'a', 'in'], { before: { x: 3 } }))).toEqual(['changed a']);
  expect(marks(one('changed', ['actors', 'a', 'states', 'Done'], {}))).toEqual(['changed a.Done']);
  expect(marks(one('removed', ['actors', 'a', 'states', 'Done'], { before: 'b' }))).toEqual([
    'removed a.Done',
  ]);
  expect(marks(one('reordered', ['actors', 'a', 'supervisors'], {}))).toEqual(['changed a']);
  const events = ['actors', 'a', 'supervisors', 's', 'events', 'Near'];
  expect(marks(one('added', events, { after: 'b' }))).toEqual(['added a/s.Near']);
  expect(marks(one('changed', ['start', 'actor'], {}))).toEqual(['changed @start.']);
  expect(marks(one('changed', ['start', 'supervisors', 'g', 'template'], {}))).toEqual([
    'changed @start/g',
  ]);
  expect(marks(one('changed', ['configuration', 'v', 'initial'], {}))).toEqual(['changed $v']);
  // Of the plan as a whole, or of where things stand, nothing is marked.
  for (const path of [['help'], ['toolboxes'], ['x'], ['layout', 'a']])
    expect(marks(one('changed', path, {}))).toEqual([]);
  expect(marks(one('reordered', ['actors'], {}))).toEqual([]);
});

test('what comes with an element, or with the first of its kind, is marked with it', () => {
  const a = {
    template: 'Wait',
    states: { Done: 'b' },
    supervisors: { s: { template: 'Timeout', events: { Timeout: 'b' } } },
  };
  const all = { a: 'added', 'a.Done': 'added', 'a/s': 'added', 'a/s.Timeout': 'added' };
  const marks = (difference: PlanDifference) => Object.fromEntries(marksIn([difference]));
  expect(marks(one('added', ['actors', 'a'], { after: a }))).toEqual(all);
  expect(marks(one('added', ['actors'], { after: { a } }))).toEqual(all);
  expect(removedIn([one('removed', ['actors', 'a'], { before: a })])).toEqual(
    new Set(Object.keys(all)),
  );
  expect(marks(one('added', ['start'], { after: { actor: 'a' } }))).toEqual({ '@start.': 'added' });
});

test('elements may be called as lists are', () => {
  const named = one('added', ['actors', 'states'], { after: { states: { events: 'states' } } });
  expect(Object.fromEntries(marksIn([named]))).toEqual({
    states: 'added',
    'states.events': 'added',
  });
  expect(marksOf(one('changed', ['actors', 'actors', 'in', 'x'], {}))).toEqual([
    { key: 'actors', kind: 'changed' },
  ]);
});

test('of random plans every removed element gets a place on which no actor stands, and its arrows a way', () => {
  for (let seed = 1; seed <= 60; seed++) {
    const random = seeded(seed);
    const before = planModel(randomPlan(random), toolboxes);
    const model = planModel(randomPlan(random), toolboxes);
    const scene = sceneOf(model);
    const gone = before.actors.filter(({ name }) => !model.actors.some((one) => one.name === name));
    const list = gone.map(({ name, template, outcomes }) =>
      one('removed', ['actors', name], {
        before: {
          template,
          states: Object.fromEntries(outcomes.map(({ name, target }) => [name, target])),
        },
      }),
    );
    const { elements, arrows } = ghostsOf(list, before, { model, scene }, () => true);
    expect(elements.map(({ key }) => key).sort(), `seed ${seed}`).toEqual(
      gone.map(({ name }) => name).sort(),
    );
    const led = gone.flatMap(({ name, outcomes }) =>
      outcomes.flatMap((one) => (one.target === null ? [] : `${name}.${one.name}`)),
    );
    expect(arrows.map(({ id }) => id).sort(), `seed ${seed}`).toEqual(led.sort());
    const taken = [...scene.actors.map(({ whole }) => whole)];
    for (const { key, box } of elements) {
      expect(
        taken.some((one) => overlaps(one, box)),
        `seed ${seed}: ${key}`,
      ).toBe(false);
      taken.push(box);
    }
  }
});

test('an arrow that leads elsewhere is drawn as it was, from where it begins now', () => {
  const plan = (target: string): Json => ({
    format: 'vagus-plan/1',
    name: 'P',
    toolboxes: [],
    start: { actor: 'a' },
    actors: {
      a: { template: 'Wait', states: { Done: target } },
      b: { template: 'Wait', states: { Done: '@terminate' } },
      c: { template: 'Wait', states: { Done: '@terminate' } },
    },
    layout: { a: [0, 0], b: [400, 0], c: [400, 300] },
  });
  const model = planModel(plan('c'), toolboxes);
  const scene = sceneOf(model);
  const moved = one('changed', ['actors', 'a', 'states', 'Done'], { before: 'b', after: 'c' });
  const { elements, arrows } = ghostsOf([moved], planModel(plan('b'), toolboxes), { model, scene });
  expect(elements).toEqual([]);
  expect(arrows.map(({ id, is }) => [id, is])).toEqual([['a.Done', 'changed']]);
  const now = drawingOf(model, scene).routes.get('a.Done')?.points ?? [];
  expect(arrows[0]?.route.points[0]).toEqual(now[0]);
  expect(arrows[0]?.route.points.at(-1)).not.toEqual(now.at(-1));
});
