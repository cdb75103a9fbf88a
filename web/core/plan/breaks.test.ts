import { expect, test } from 'vitest';
import type { PlanBreakpoint } from '../../protocol/messages';
import { discOf, keyOfBreak, placeOf, renamed } from './breaks';
import { planModel } from './model';

const model = planModel(
  {
    name: 'P',
    start: {
      actor: 'go',
      supervisors: { esc: { template: 'T', events: { Pressed: '@terminate' } } },
    },
    actors: {
      go: {
        template: 'A',
        states: { Done: 'go' },
        supervisors: { two: { template: 'T', events: { Left: 'go', Right: 'go' } } },
      },
    },
  },
  [],
);
const one: PlanBreakpoint = {
  number: 1,
  doc: 'P.plan.json',
  kind: 'actor',
  element: 'go',
  outcome: '',
  condition: '',
  stop_at: 1,
  enabled: true,
  hits: 0,
  set: true,
};

test('what is drawn has a place to stop at, and the place is drawn there', () => {
  for (const [key, kind, element, outcome] of [
    ['go', 'actor', 'go', ''],
    ['go.Done', 'state', 'go', 'Done'],
    ['@start/esc', 'event', 'esc', 'Pressed'],
    ['go/two', 'event', 'two', ''],
    ['go/two.Right', 'event', 'two', 'Right'],
  ] as const) {
    expect(placeOf(model, key)).toEqual({ kind, element, outcome });
    expect(keyOfBreak(model, { kind, element, outcome })).toBe(key);
  }
});

test('the start, a variable and what is not there have none', () => {
  expect(placeOf(model, '@start')).toBeNull();
  expect(placeOf(model, '$n')).toBeNull();
  expect(placeOf(model, null)).toBeNull();
  expect(keyOfBreak(model, { kind: 'actor', element: 'gone', outcome: '' })).toBeNull();
  expect(keyOfBreak(model, { kind: 'condition', element: '', outcome: '' })).toBeNull();
});

test('the disc tells whether it always stops', () => {
  expect(discOf(one)).toBe('on');
  expect(discOf({ ...one, condition: 'n > 1' })).toBe('if');
  expect(discOf({ ...one, stop_at: 2 })).toBe('if');
  expect(discOf({ ...one, enabled: false, condition: 'n > 1' })).toBe('off');
  expect(discOf({ ...one, set: false, why: 'no such actor' })).toBe('unset');
  expect(discOf({ ...one, kind: 'condition', condition: 'n > 1' })).toBe('on');
});

test('a change that gives one element another name is a renaming, others are none', () => {
  const plan = (actors: string[], supervisors: string[]) =>
    planModel(
      {
        name: 'P',
        start: {
          actor: 'a',
          supervisors: Object.fromEntries(supervisors.map((name) => [name, { template: 'T' }])),
        },
        actors: Object.fromEntries(actors.map((name) => [name, { template: 'A' }])),
      },
      [],
    );
  const before = plan(['a', 'b'], ['s']);
  expect(renamed(before, plan(['a', 'c'], ['s']))).toEqual({ is: 'actor', from: 'b', to: 'c' });
  expect(renamed(before, plan(['a', 'b'], ['t']))).toEqual({
    is: 'supervisor',
    from: 's',
    to: 't',
  });
  expect(renamed(before, before)).toBeNull();
  expect(renamed(before, plan(['a'], ['s']))).toBeNull();
  expect(renamed(before, plan(['a', 'b', 'c'], ['s']))).toBeNull();
  expect(renamed(before, plan(['c', 'd'], ['s']))).toBeNull();
  expect(renamed(before, plan(['a', 'c'], ['t']))).toBeNull();
});
