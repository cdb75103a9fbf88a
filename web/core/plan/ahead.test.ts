import { expect, test } from 'vitest';
import { aheadText, inputsAhead } from './ahead';
import { planModel } from './model';
import { template } from './test_plans';

test('WhatAnActorWillTakeIsToldByItsFormulasAndTheValuesTheyName', () => {
  const input = (name: string) => ({ name, type: 'float' as const, unit: 's', help: '' });
  const wait = {
    ...template('Wait', 'actor', ['Done']),
    inputs: [input('seconds'), { ...input('more'), default: 5 }, input('unfed')],
  };
  const file = { name: 'P', actors: { go: { template: 'Wait', in: { seconds: 'n * 20' } } } };
  const [go] = planModel(file, [{ name: 'core', help: '', templates: [wait] }]).actors;
  const values = new Map([
    ['n', '3'],
    ['other', '4'],
  ]);
  expect(aheadText(inputsAhead(go), values)).toBe('seconds = n * 20 s · more = 5 s · n 3');
  expect(inputsAhead(undefined)).toEqual([]);
});
