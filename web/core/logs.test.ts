import { describe, expect, test } from 'vitest';
import { kLogPointsMax, kSlowMs, Logs, logsCsv, type Logged, type LogPlace } from './logs';

const line = (at: number): LogPlace => ({ is: 'line', doc: 'a.aesl#1', line: at });
const found = (...ts: number[]): Logged => ({
  names: ['x'],
  hits: ts.map((t) => ({ t, where: 'left:3', values: [`${t * 2}`] })),
  more: 0,
  until: 9,
  text: '',
});

interface Asked {
  input: { number: number; values: string };
  answer(found: Logged): void;
  refuse(why: string): void;
}

function house() {
  const asked: Asked[] = [];
  const cancelled: number[] = [];
  const later: (() => void)[] = [];
  const logs = new Logs({
    ask: (input) =>
      new Promise((resolve, reject) =>
        asked.push({ input, answer: resolve, refuse: (why) => reject(new Error(why)) }),
      ),
    cancel: (number) => void cancelled.push(number),
    later(ms, act) {
      expect(ms).toBe(kSlowMs);
      later.push(act);
      return () => void later.splice(later.indexOf(act), 1);
    },
  });
  logs.told('1');
  return { logs, asked, cancelled, later };
}

const settled = () => new Promise((resolve) => setTimeout(resolve));

describe('log points in a run that was', () => {
  test('one is asked after the other, and their hits are in the order of time', async () => {
    const { logs, asked } = house();
    logs.add(line(3));
    logs.add(line(5));
    logs.ask(1, 'x');
    logs.ask(2, 'y');
    expect(asked.map(({ input }) => input)).toEqual([
      { number: 1, doc: 'a.aesl#1', line: 3, values: 'x' },
    ]);
    asked[0]?.answer(found(1, 4));
    await settled();
    expect(logs.points.map(({ state }) => state)).toEqual(['told', 'waits']);
    asked[1]?.answer(found(2));
    await settled();
    expect(logs.rows.map(({ t, point }) => [t, point.number])).toEqual([
      [1, 1],
      [2, 2],
      [4, 1],
    ]);
    expect(logs.rows[0]?.values).toEqual([{ name: 'x', text: '2' }]);
  });

  test('a place has one, and there are only so many', () => {
    const { logs } = house();
    expect(logs.add(line(3))).toBe(true);
    logs.add({ is: 'actor', doc: 'P.plan.json', element: 'wait', when: 'enter' });
    logs.move(2, 'leave');
    logs.add({ is: 'actor', doc: 'P.plan.json', element: 'wait', when: 'enter' });
    logs.add(line(3));
    expect(logs.wanted).toBe(1);
    expect(logs.points).toHaveLength(2);
    for (let at = 4; at < 2 + kLogPointsMax; ++at) expect(logs.add(line(at))).toBe(true);
    expect(logs.add(line(99))).toBe(false);
    expect(logs.add(line(3))).toBe(true);
  });

  test('what was asked before counts no more, and is cancelled', async () => {
    const { logs, asked, cancelled } = house();
    logs.add(line(3));
    logs.ask(1, 'x');
    logs.ask(1, 'x + 1');
    expect(cancelled).toEqual([1]);
    asked[0]?.answer(found(1));
    await settled();
    expect(logs.rows).toEqual([]);
    asked[1]?.answer(found(2, 3));
    await settled();
    expect(logs.rows).toHaveLength(2);
    logs.ask(1, 'z');
    logs.cancel(1);
    expect(logs.points[0]?.state).toBe('typed');
    logs.ask(1, 'z');
    logs.remove(1);
    expect(cancelled).toEqual([1, 1, 1]);
    asked[3]?.answer(found(1));
    await settled();
    expect(logs.points).toEqual([]);
  });

  test('a refusal is told, and the next is asked', async () => {
    const { logs, asked } = house();
    logs.add(line(3));
    logs.add(line(5));
    logs.ask(1, 'y');
    logs.ask(2, 'x');
    asked[0]?.refuse('there is no variable "y"');
    await settled();
    expect(logs.points[0]).toMatchObject({
      state: 'refused',
      trouble: 'there is no variable "y"',
      values: 'y',
    });
    expect(asked).toHaveLength(2);
  });

  test('hits of another run are not shown, and its answers count no more', async () => {
    const { logs, asked, cancelled } = house();
    logs.add(line(3));
    logs.add(line(5));
    logs.ask(1, 'x');
    asked[0]?.answer(found(1));
    await settled();
    logs.ask(2, 'x');
    logs.told('1');
    expect(logs.rows).toHaveLength(1);
    logs.told('2');
    expect(cancelled).toEqual([2]);
    asked[1]?.answer(found(2));
    await settled();
    expect(logs.rows).toEqual([]);
    expect(logs.points.map(({ state, values }) => [state, values])).toEqual([
      ['typed', 'x'],
      ['typed', 'x'],
    ]);
  });

  test('an answer that is slow is said to be, until it is there', async () => {
    const { logs, asked, later } = house();
    logs.add(line(3));
    logs.ask(1, 'x');
    expect(logs.isSlow).toBe(false);
    later[0]?.();
    expect(logs.isSlow).toBe(true);
    asked[0]?.answer(found());
    await settled();
    expect([logs.isSlow, logs.asking, later.length]).toEqual([false, null, 0]);
  });

  test('as a table each value is a column', async () => {
    const { logs, asked } = house();
    logs.add(line(3));
    logs.add(line(5));
    logs.ask(1, 'x');
    asked[0]?.answer(found(1));
    await settled();
    logs.ask(2, 'y');
    asked[1]?.answer({
      ...found(2),
      names: ['list'],
      hits: [{ t: 2, where: '', values: ['[1, 2]'] }],
    });
    await settled();
    expect(logsCsv(logs.rows, ({ where }) => where || 'P')).toBe(
      't,place,x,list\r\n1.000,left:3,2,\r\n2.000,P,,"[1, 2]"\r\n',
    );
  });
});
