import { expect, test } from 'vitest';
import type { PlanLevel, Topics } from '../../protocol/messages';
import { livePlan } from './live';
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
        states: { Done: 'back' },
        supervisors: { touch: { template: 'T', events: { Touched: 'back' } } },
      },
      back: { template: 'A', states: { Done: 'go' } },
    },
  },
  [],
);
const level: PlanLevel = {
  path: 'P',
  doc: 'P.plan.json',
  actor: 'back',
  template: 'A',
  activation: 2,
  since: 3,
  inputs: { distance: 30.00001, text: 'so' },
  variables: [{ name: 'n', type: 'int', value: 4, unit: '' }],
  supervisors: [{ name: 'esc', global: true, watching: true, events: ['Pressed'] }],
  counts: [
    { is: 'actor', name: 'go', times: 1, seconds: 3, last: 3 },
    { is: 'supervisor', name: 'touch', times: 1, seconds: 0, last: 0 },
  ],
  taken: { number: 2, is: 'event', element: 'touch', outcome: 'Touched', target: 'back' },
};
const plan: Topics['plan']['is'] = {
  state: 'paused',
  t: 4,
  levels: [level],
  story: [],
  stands_at: [7],
};

test('the arrow is the one that the server names, by the supervisor and its owner', () => {
  expect(livePlan(plan, level, model).taken).toBe('go/touch.Touched');
  const started = {
    ...level,
    taken: { number: 1, is: 'start' as const, element: '', outcome: '', target: 'go' },
  };
  expect(livePlan(plan, started, model).taken).toBe('@start.');
  const gone = {
    ...level,
    taken: { number: 3, is: 'event' as const, element: 'old', outcome: 'X', target: 'go' },
  };
  expect(livePlan(plan, gone, model).taken).toBeNull();
});

test('turns are by element, inputs are what the formulas gave', () => {
  const live = livePlan(plan, level, model);
  expect([...live.turns]).toEqual([
    ['go', { times: 1, seconds: 3 }],
    ['go/touch', { times: 1, seconds: 0 }],
  ]);
  expect([...live.inputs]).toEqual([
    ['distance', '30'],
    ['text', 'so'],
  ]);
  expect([...live.watching]).toEqual(['@start/esc']);
  expect(live.pausedLineOf).toEqual([7]);
});

test('a plan that is over has no active actor, and keeps its counts', () => {
  const live = livePlan({ ...plan, state: 'ended' }, level, model);
  expect(live.actor).toBe('');
  expect(live.watching.size).toBe(0);
  expect(live.turns.get('go')?.times).toBe(1);
});
