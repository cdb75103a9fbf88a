import { expect, test } from 'vitest';
import type { ComparedRun } from '../protocol/messages';
import { namesIn, Pairing, placeAt, spanOf, type Compared } from './pairing';

const run = (start: number, end: number, actors: string[]): ComparedRun => ({
  path: `run-${start}.mcap`,
  start,
  end,
  complete: true,
  actors: actors.map((name, at) => ({ name, level: 0, from: at, to: at + 1 })),
  events: [],
  ways: [],
  more: 0,
});
const found = (t?: number): Compared => ({
  a: run(2, 10, ['go', 'turn']),
  b: run(5, 12, ['turn', 'stop']),
  lanes: [{ name: '/plan/trace', compared: 3, ...(t === undefined ? {} : { t }) }],
  started: [],
  scene: [],
});

function house() {
  const inputs: unknown[] = [];
  const answers: ((found: Compared) => void)[] = [];
  const refusals: ((why: Error) => void)[] = [];
  const pairing = new Pairing((input) => {
    inputs.push(input);
    return new Promise((resolve, reject) => {
      answers.push(resolve);
      refusals.push(reject);
    });
  });
  return { pairing, inputs, answers, refusals };
}

test('two runs are asked for, and the first difference of both is shown', async () => {
  const { pairing, inputs, answers } = house();
  pairing.choose({ b: 'run-2.mcap', align: 'actor', name: ' turn ' });
  const done = pairing.ask();
  expect(pairing.waits).toBe(true);
  expect(inputs).toEqual([{ b: 'run-2.mcap', align: 'actor', name: 'turn' }]);
  answers[0]?.(found(1.5));
  await done;
  expect([pairing.waits, pairing.t]).toEqual([false, 1.5]);
});

test('what was asked before, and of a run that is not shown any more, counts no more', async () => {
  const { pairing, answers, refusals } = house();
  pairing.choose({ a: 'run-1.mcap', b: 'run-2.mcap' });
  const first = pairing.ask();
  const second = pairing.ask();
  answers[0]?.(found(1));
  await first;
  expect(pairing.found).toBeNull();
  answers[1]?.(found());
  await second;
  pairing.toldOfRun();
  expect([pairing.found !== null, pairing.t]).toEqual([true, 0]);
  // The run that was shown is named by its recording then.
  pairing.choose({ a: null });
  const third = pairing.ask();
  answers[2]?.(found());
  await third;
  pairing.toldOfRun();
  expect(pairing.asked).toMatchObject({ a: 'run-2.mcap', b: 'run-2.mcap' });
  expect(pairing.wish.a).toBe('run-2.mcap');
  pairing.choose({ a: null });
  const fourth = pairing.ask();
  refusals[3]?.(new Error('nothing has run yet'));
  await fourth;
  expect([pairing.found, pairing.trouble]).toEqual([null, 'nothing has run yet']);
  pairing.toldOfRun();
  expect([pairing.asked, pairing.trouble]).toEqual([null, '']);
});

test('both lie on one axis, and what both have is offered', () => {
  expect(spanOf(found())).toEqual({ from: -5, to: 8 });
  expect(spanOf(null)).toEqual({ from: 0, to: 0 });
  expect(namesIn(found(), 'actor')).toEqual(['turn']);
  expect(namesIn(found(), 'start')).toEqual([]);
});

test('an instant is looked at within both', async () => {
  const { pairing, answers } = house();
  const done = pairing.ask();
  answers[0]?.(found(1));
  await done;
  pairing.look(99);
  expect(pairing.t).toBe(8);
  pairing.look(-99);
  expect(pairing.t).toBe(-5);
});

test('a robot is where it was seen last', () => {
  const way = { robot: 'r', length: 1, width: 1, points: [1, 0, 0, 0, 2, 5, 6, 1.5] };
  expect(placeAt(way, 0.5)).toBeNull();
  expect(placeAt(way, 1.9)).toEqual([0, 0, 0]);
  expect(placeAt(way, 2)).toEqual([5, 6, 1.5]);
});
