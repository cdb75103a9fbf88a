import { expect, test } from 'vitest';
import type { PlanCoverage } from '../../protocol/messages';
import { countedIn, takenIn } from './coverage';
import { planModel } from './model';

const counts: PlanCoverage = {
  actors: { go: 3, stay: 0 },
  states: { 'go: Done': 2, 'stay: Done': 0 },
  supervisors: { touch: 1, 'go.timer': 0 },
  events: { 'touch: Pressed': 1, 'go.timer: Over': 0 },
  pairs: { 'go, stay': 0 },
};

const model = planModel(
  {
    start: { actor: 'go', supervisors: { touch: { template: 'T', events: { Pressed: 'stay' } } } },
    actors: {
      go: {
        template: 'A',
        states: { Done: 'stay' },
        supervisors: { timer: { template: 'T', events: { Over: 'stay' } } },
      },
      stay: { template: 'A', states: { Done: '@terminate' } },
      young: { template: 'A', states: { Done: 'go' } },
    },
  },
  [],
);

test('each count is at its element or arrow; what came since has none', () => {
  expect(takenIn(model, counts).map(({ key, count }) => `${key} ${count}`)).toEqual([
    'go 3',
    'go.Done 2',
    'stay 0',
    'stay.Done 0',
    '@start/touch 1',
    '@start/touch.Pressed 1',
    'go/timer 0',
    'go/timer.Over 0',
  ]);
});

test('the list knows what of the drawing each is about', () => {
  const keys = countedIn(counts).map(({ keys }) => keys.join(' '));
  expect(keys).toEqual([
    'go',
    'stay',
    'go.Done',
    'stay.Done',
    '@start/touch',
    'go/timer',
    '@start/touch.Pressed',
    'go/timer.Over',
    'go stay',
  ]);
});
