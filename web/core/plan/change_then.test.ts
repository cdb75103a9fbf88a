import { expect, it } from 'vitest';
import type { PlanDifference, PlanLevel } from '../../protocol/messages';
import { keptOf, startValues } from './change_then';

const level: PlanLevel = {
  path: 'Drive',
  doc: 'Drive.plan.json',
  actor: 'forward',
  template: 'Forward',
  activation: 3,
  since: 12.4,
  inputs: {},
  variables: [
    { name: 'near', type: 'float', value: 30, unit: 'cm' },
    { name: 'far', type: 'float', value: 80, unit: 'cm' },
  ],
  supervisors: [],
  counts: [],
};
const changed = (path: string[], after: unknown = 1): PlanDifference => ({
  kind: 'changed',
  element: '',
  part: '',
  path,
  before: 0,
  after: after as number,
});

it('an active actor keeps its inputs and those of its supervisors', () => {
  for (const path of [
    ['actors', 'forward', 'in', 'speed'],
    ['actors', 'forward', 'template'],
    ['actors', 'forward', 'supervisors', 'lane', 'in', 'distance'],
    ['actors', 'forward', 'supervisors', 'lane'],
  ])
    expect(keptOf(level, [changed(path)]), path.join('.')).toBe(true);
});

it('targets count at once, and other actors have not started', () => {
  for (const path of [
    ['actors', 'forward', 'states', 'ForwardSuccessful'],
    ['actors', 'forward', 'supervisors', 'lane', 'events', 'LaneNotFree'],
    ['actors', 'forward', 'help'],
    ['actors', 'turn', 'in', 'angle'],
    ['configuration', 'near', 'initial'],
  ])
    expect(keptOf(level, [changed(path)]), path.join('.')).toBe(false);
});

it('a variable keeps its value where its initial one is another', () => {
  const differences = [
    changed(['configuration', 'near', 'initial'], 50),
    changed(['configuration', 'far', 'initial'], 80),
    changed(['configuration', 'far', 'help'], 'how far'),
    changed(['configuration', 'gone', 'initial'], 2),
  ];
  expect(startValues(level, differences)).toEqual([{ name: 'near', then: 30, to: 50 }]);
});
