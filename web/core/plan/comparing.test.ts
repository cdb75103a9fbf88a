import { expect, test } from 'vitest';
import type { Commands, PlanDifference } from '../../protocol/messages';
import { Comparing } from './comparing';

type Output = Commands['plan.differences']['out'];
const changed = (...path: string[]): PlanDifference => ({
  kind: 'changed',
  element: '',
  part: '',
  path,
});
const answer = (...differences: PlanDifference[]): Output => ({
  version: 1,
  before: '{}',
  differences,
});
const disk = { against: 'disk', name: 'the file on disk' } as const;

test('differences are gone through in a circle; places are counted apart', async () => {
  const comparing = new Comparing(() =>
    Promise.resolve(answer(changed('help'), changed('layout', 'a'), changed('name'))),
  );
  comparing.compare('P.plan.json', disk);
  await comparing.ask();
  expect(comparing.answer?.places).toBe(1);
  expect(comparing.current).toBeUndefined();
  const seen: (string | undefined)[] = [];
  for (const by of [1, 1, 1, -1] as const) {
    comparing.step(by);
    seen.push(comparing.current?.path[0]);
  }
  expect(seen).toEqual(['help', 'name', 'help', 'name']);
  comparing.leave();
  comparing.step(1);
  expect(comparing.current).toBeUndefined();
});

test('an edit that ends differences leaves the one that is looked at among those that are left', async () => {
  const answers = [answer(changed('help'), changed('name')), answer(changed('help')), answer()];
  const comparing = new Comparing(() => Promise.resolve(answers.shift() ?? answer()));
  comparing.compare('P.plan.json', disk);
  await Promise.resolve();
  comparing.step(-1);
  expect(comparing.current?.path).toEqual(['name']);
  await comparing.ask();
  expect(comparing.current?.path).toEqual(['help']);
  await comparing.ask();
  expect(comparing.at).toBeNull();
});

test('an answer about another version counts no more; what cannot be compared says why', async () => {
  const inputs: unknown[] = [];
  const waits: ((is: Output | Error) => void)[] = [];
  const comparing = new Comparing((input) => {
    inputs.push(input);
    return new Promise((resolve, reject) =>
      waits.push((is) => (is instanceof Error ? reject(is) : resolve(is))),
    );
  });
  comparing.compare('P.plan.json', disk);
  comparing.compare('P.plan.json', {
    against: 'revision',
    revision: 'HEAD~1',
    name: 'a commit',
  });
  waits[0]?.(answer(changed('help')));
  waits[1]?.(new Error('git does not have it'));
  await new Promise((resolve) => setImmediate(resolve));
  expect(inputs).toEqual([
    { doc: 'P.plan.json', against: 'disk' },
    { doc: 'P.plan.json', against: 'revision', revision: 'HEAD~1' },
  ]);
  expect(comparing.answer).toBeNull();
  expect(comparing.trouble).toBe('git does not have it');
});
