import { expect, test } from 'vitest';
import type { TestFailure, TestRun } from '../protocol/messages';
import { failedPlaces, isAsRun, stateOf, TestOptions, type Tests } from './tests';

const run = (values: Partial<TestRun>): TestRun => ({
  path: 'A.test.json',
  runs: 3,
  done: 0,
  failed: 0,
  failures: [],
  ...values,
});
const running = { state: 'running' } as const;
const stopped = { state: 'stopped' } as const;

test('how a test is follows from what is done of it', () => {
  expect(stateOf(run({}), running)).toBe('waits');
  expect(stateOf(run({ done: 1 }), running)).toBe('runs');
  expect(stateOf(run({ done: 3 }), running)).toBe('ok');
  expect(stateOf(run({ done: 1, failed: 1 }), running)).toBe('failed');
  expect(stateOf(run({ done: 2 }), stopped)).toBe('stopped');
  expect(stateOf(run({ runs: 0, why: 'no plan' }), running)).toBe('refused');
});

test('failures of one place are one mark, in the order of the file', () => {
  const at = (line: number, seed: number): TestFailure => ({
    seed,
    what: 'x',
    at: { line, column: 3 },
  });
  const places = failedPlaces([at(9, 1), at(4, 1), at(9, 2), { seed: 3, what: 'crashed' }]);
  expect(places.map(({ at: { line }, count, first }) => [line, count, first.seed])).toEqual([
    [4, 1, 1],
    [9, 2, 1],
  ]);
});

test('a script is as it was run unless its file has changed', () => {
  const tests: Tests = {
    state: 'done',
    runs: 0,
    done: 0,
    failed: 0,
    scripts: false,
    tests: [],
    coverage: [],
    changed: ['robot.aesl'],
  };
  expect(isAsRun(tests, 'robot.aesl#2')).toBe(false);
  expect(isAsRun(tests, 'P.plan.json')).toBe(true);
  expect(isAsRun(undefined, 'P.plan.json')).toBe(false);
});

test('what is chosen is kept, and told', () => {
  const kept: unknown[] = [];
  const options = new TestOptions({ scripts: false, coverage: true }, (value) => kept.push(value));
  let told = 0;
  options.changed.on(() => (told += 1));
  options.toggle('scripts');
  options.toggle('coverage', true);
  expect(options.scripts).toBe(true);
  expect(kept).toEqual([
    { scripts: true, coverage: true },
    { scripts: true, coverage: true },
  ]);
  expect(told).toBe(2);
});
