import { expect, test } from 'vitest';
import type { Commands, TryChoice } from '../../protocol/messages';
import { Trying, type Tried } from './trying';

const choice = (element: string, outcome: string, path = 'Hall'): TryChoice => ({
  path,
  element,
  outcome,
});
const waiting = (more: Partial<Tried> = {}): Tried => ({
  plan: { state: 'paused', t: 0, levels: [], story: [] },
  waits: { path: 'Hall', actor: 'drive', states: ['Done', 'Blocked'], outputs: [] },
  raises: [{ path: 'Hall', supervisor: 'near', events: ['Near'] }],
  turns: [],
  taken: [],
  left: 0,
  ...more,
});

test('states come before events, and each choice is asked with all before it', async () => {
  const asked: Commands['plan.try']['in'][] = [];
  const trying = new Trying((input) => {
    asked.push(input);
    return Promise.resolve(waiting());
  });
  trying.start('Hall.plan.json');
  await new Promise((resolve) => setImmediate(resolve));
  expect(trying.options.map(({ is, element, outcome }) => [is, element, outcome])).toEqual([
    ['state', 'drive', 'Done'],
    ['state', 'drive', 'Blocked'],
    ['event', 'near', 'Near'],
  ]);
  const [, blocked, near] = trying.options;
  if (blocked) await trying.choose(blocked);
  if (near) await trying.choose(near);
  expect(asked.at(-1)?.way).toEqual([choice('drive', 'Blocked'), choice('near', 'Near')]);
  await trying.back(1);
  expect(trying.way).toEqual([choice('drive', 'Blocked')]);
});

test('a number pressed before its answer is there is for what that offers', async () => {
  const asked: Commands['plan.try']['in'][] = [];
  const trying = new Trying((input) => {
    asked.push(input);
    return Promise.resolve(waiting());
  });
  trying.start('Hall.plan.json');
  for (const number of [2, 3, 1]) void trying.press(number);
  await new Promise((resolve) => setImmediate(resolve));
  expect(asked.map(({ way }) => way.length)).toEqual([0, 1, 2, 3]);
  expect(asked.at(-1)?.way).toEqual([
    choice('drive', 'Blocked'),
    choice('near', 'Near'),
    choice('drive', 'Done'),
  ]);
  // One that nothing has ends what was pressed ahead; so does a step back.
  void trying.press(9);
  for (const number of [1, 9, 1]) void trying.press(number);
  await new Promise((resolve) => setImmediate(resolve));
  expect(trying.way).toHaveLength(4);
  void trying.press(1);
  void trying.press(1);
  await trying.back(2);
  expect(trying.way).toHaveLength(2);
});

test('outputs go with a state, not with an event; a wrong one is refused', async () => {
  const asked: Commands['plan.try']['in'][] = [];
  const distance = { name: 'distance', type: 'float' } as const;
  const near = { name: 'near', type: 'bool' } as const;
  const trying = new Trying((input) => {
    asked.push(input);
    const outputs = [distance, near];
    return Promise.resolve(
      waiting({ waits: { path: 'Hall', actor: 'drive', states: ['Done'], outputs } }),
    );
  });
  trying.start('Hall.plan.json');
  await new Promise((resolve) => setImmediate(resolve));
  const [done, event] = trying.options;
  if (done === undefined || event === undefined) throw new Error('nothing to choose');
  trying.type(distance, 'far');
  expect(trying.isWrong(distance)).toBe(true);
  await trying.choose(done);
  expect(asked).toHaveLength(1);
  await trying.choose(event);
  expect(asked.at(-1)?.way).toEqual([choice('near', 'Near')]);
  // What was typed was about that situation.
  trying.type(distance, '2.5');
  await trying.choose(done);
  expect(asked.at(-1)?.way[1]).toEqual({
    ...choice('drive', 'Done'),
    out: [{ name: 'distance', value: 2.5 }],
  });
});

test('one goes back to where an actor began by the choices that were taken until then', async () => {
  const trying = new Trying(() => Promise.resolve(waiting({ taken: [1, 2, 3] })));
  trying.start('Hall.plan.json');
  for (const outcome of ['Done', 'Blocked', 'Done']) {
    await new Promise((resolve) => setImmediate(resolve));
    await trying.choose(choice('drive', outcome));
  }
  await trying.backTo({ path: 'Hall', actor: 'drive', from: 2 });
  expect(trying.way.map(({ outcome }) => outcome)).toEqual(['Done', 'Blocked']);
});

test('choices that do not fit the edited plan are dropped; what is wrong with it is said', async () => {
  const answers: (Tried | Error)[] = [waiting(), waiting(), waiting({ left: 1 })];
  const trying = new Trying(() => {
    const next = answers.shift() ?? new Error('it has an error');
    return next instanceof Error ? Promise.reject(next) : Promise.resolve(next);
  });
  trying.start('Hall.plan.json');
  await new Promise((resolve) => setImmediate(resolve));
  await trying.choose(choice('drive', 'Done'));
  expect(trying.way).toHaveLength(1);
  await trying.again();
  expect(trying.way).toEqual([]);
  await trying.again();
  expect(trying.trouble).toBe('it has an error');
  trying.leave();
  expect([trying.doc, trying.answer, trying.trouble]).toEqual([null, null, '']);
});

test('where it gave way to a run it goes on when the plan is tried again; left, it begins', async () => {
  const asked: Commands['plan.try']['in'][] = [];
  const trying = new Trying((input) => {
    asked.push(input);
    return Promise.resolve(waiting());
  });
  const settled = () => new Promise((resolve) => setImmediate(resolve));
  trying.start('Hall.plan.json');
  await settled();
  await trying.choose(choice('drive', 'Done'));
  trying.giveWay();
  expect([trying.doc, trying.answer]).toEqual([null, null]);
  trying.start('Hall.plan.json');
  await settled();
  expect(asked.at(-1)?.way).toEqual([choice('drive', 'Done')]);
  trying.leave();
  trying.start('Hall.plan.json');
  expect(asked.at(-1)?.way).toEqual([]);
});

test('two presses in one situation choose once, and an answer after the end counts no more', async () => {
  const waits: ((answer: Tried) => void)[] = [];
  const trying = new Trying(() => new Promise((resolve) => waits.push(resolve)));
  trying.start('Hall.plan.json');
  waits[0]?.(waiting());
  await new Promise((resolve) => setImmediate(resolve));
  void trying.choose(choice('drive', 'Done'));
  void trying.choose(choice('drive', 'Done'));
  expect(waits).toHaveLength(2);
  trying.leave();
  waits[1]?.(waiting());
  await new Promise((resolve) => setImmediate(resolve));
  expect(trying.answer).toBeNull();
});

test('a mistake in the plan is told without the folder of this computer', async () => {
  const trying = new Trying(() =>
    Promise.reject(new Error('/home/me/P.plan.json:12:3: error: drive: it leads nowhere [P17]')),
  );
  trying.start('P.plan.json');
  await new Promise((resolve) => setImmediate(resolve));
  expect(trying.trouble).toBe('P.plan.json:12:3: drive: it leads nowhere [P17]');
});
