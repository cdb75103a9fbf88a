import { expect, it } from 'vitest';
import type { PlanLevel, Topics } from '../../protocol/messages';
import { pausedPlace, pausedStep } from './paused';

const level = (doc: string, actor: string, activation = 1): PlanLevel => ({
  path: doc,
  doc,
  actor,
  template: 'Wait',
  activation,
  since: 0,
  inputs: {},
  variables: [],
  supervisors: [],
  counts: [],
});
type Plan = Topics['plan']['is'];
const plan = (state: Plan['state'], ...levels: PlanLevel[]): Plan => ({
  state,
  t: 1,
  levels,
  story: [],
});

it('is in the innermost plan that has an active actor', () => {
  const paused = plan('paused', level('Day', 'nap'), level('Nap', 'wait'));
  expect(pausedPlace(paused)).toEqual({ doc: 'Nap', actor: 'wait', caller: 'Day' });
  const begins = plan('paused', level('Day', 'nap'), level('Nap', ''));
  expect(pausedPlace(begins)).toEqual({ doc: 'Day', actor: 'nap', caller: null });
  expect(pausedPlace(plan('paused', level('Day', '')))?.doc).toBe('Day');
});

it('is nowhere while the plan runs, or without one', () => {
  expect(pausedPlace(plan('running', level('Day', 'nap')))).toBe(null);
  expect(pausedPlace(plan('paused'))).toBe(null);
  expect(pausedStep(plan('running', level('Day', 'nap')))).toBe('');
});

it('is another one with each step, and the same while nothing happens', () => {
  const first = plan('paused', level('Day', 'nap', 1));
  expect(pausedStep({ ...first, t: 2 })).toBe(pausedStep(first));
  expect(pausedStep(plan('paused', level('Day', 'nap', 2)))).not.toBe(pausedStep(first));
  expect(pausedStep(plan('paused', level('Day', 'nap'), level('Nap', 'wait')))).not.toBe(
    pausedStep(first),
  );
});
