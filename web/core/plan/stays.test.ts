// Nothing moves that was not touched: what has no place in the file stays where it was drawn.
import { expect, it } from 'vitest';
import { planModel } from './model';
import { found, sceneOf, type Places, type Scene } from './place';

const actor = (to: string) => ({ template: 'Wait', in: { seconds: 1 }, states: { Done: to } });
const plan = (more: object = {}, layout: object = {}) => ({
  format: 'vagus-plan/1',
  name: 'P',
  configuration: { x: { type: 'int', initial: 1 } },
  start: { actor: 'a' },
  actors: { a: actor('b'), b: actor('@terminate'), ...more },
  layout,
});
const template = (name: string, kind: 'actor' | 'supervisor', outcome: string) => ({
  name,
  kind,
  help: '',
  icon: '',
  inputs: [],
  outputs: [],
  states: kind === 'actor' ? [{ name: outcome, help: '' }] : [],
  events: kind === 'supervisor' ? [{ name: outcome, help: '' }] : [],
});
const toolboxes = [
  {
    name: 'core',
    help: '',
    templates: [template('Wait', 'actor', 'Done'), template('Timeout', 'supervisor', 'Timeout')],
  },
] as never;
const model = (value: object) => planModel(value as never, toolboxes);

function placesIn({ start, actors, configuration }: Scene) {
  const all = [start, ...actors].map(({ name, box }) => [name, [box.x, box.y]]);
  return Object.fromEntries([...all, ['pills', [configuration.x, configuration.y]]]) as Record<
    string,
    number[]
  >;
}

function drawnAfter(
  first: object,
  then: object,
): { before: Record<string, number[]>; after: Record<string, number[]> } {
  const scene = sceneOf(model(first));
  const known: Places = found(model(first), scene, new Map());
  return { before: placesIn(scene), after: placesIn(sceneOf(model(then), known)) };
}

it('an actor that is dropped moves no other', () => {
  const dropped = plan({ c: actor('a') }, { c: [80, -400] });
  const { before, after } = drawnAfter(plan(), dropped);
  expect(after).toEqual({ ...before, c: [80, -400] });
  // Without what was known they would be elsewhere: the test means something.
  expect(placesIn(sceneOf(model(dropped)))).not.toEqual(after);
});

it('an actor that is deleted moves no other', () => {
  const { before, after } = drawnAfter(plan({ c: actor('a') }), plan());
  const { c: _, ...rest } = before;
  expect(after).toEqual(rest);
});

it('an actor that gets a place moves no other, and goes back where it was', () => {
  const { before, after } = drawnAfter(plan(), plan({}, { b: [800, 800] }));
  expect(after).toEqual({ ...before, b: [800, 800] });
  const placed = model(plan({}, { b: [800, 800] }));
  const known = found(
    placed,
    sceneOf(placed, new Map()),
    found(model(plan()), sceneOf(model(plan())), new Map()),
  );
  expect(placesIn(sceneOf(model(plan()), known))['b']).toEqual(before['b']);
});

it('what a grown neighbour covers finds another place', () => {
  const guard = (event: string) => ({
    template: 'Timeout',
    in: { seconds: 1 },
    events: { [event]: '@terminate' },
  });
  const grown = plan();
  const start = {
    actor: 'a',
    supervisors: { one: guard('Timeout'), two: guard('Timeout'), three: guard('Timeout') },
  };
  const { before, after } = drawnAfter(plan(), { ...grown, start });
  expect(after['a']).toEqual(before['a']);
  const scene = sceneOf(
    model({ ...grown, start }),
    found(model(plan()), sceneOf(model(plan())), new Map()),
  );
  const [first] = scene.actors;
  expect(first && scene.start.whole.y + scene.start.whole.height <= first.whole.y).toBe(true);
});
