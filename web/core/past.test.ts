import { describe, expect, it } from 'vitest';
import type { Json } from '../protocol/messages';
import type { Connection } from './connection';
import { Past, type Instant } from './past';
import type { TopicCache } from './topics';

interface Asked {
  input: { t: number; events?: number; trace?: string; robot?: string };
  answer(more?: Partial<Instant>): Promise<void>;
}

const of = ({ robot }: Asked['input']) => (robot ? { robots: ['r1', robot], robot } : {});

/** A server that answers when it is told to; its history goes from 10 s to 100 s. */
function aPast() {
  const asked: Asked[] = [];
  const history = { run: 1, kind: 'simulated', name: 'x', from: 10, to: 100 };
  const connection = {
    send: (command: string, input: Asked['input']) => {
      if (command === 'history.open')
        return Promise.resolve({ from: 2, to: 7, lines: 3, refused: 0, plan: true, ...of(input) });
      return new Promise((resolve) =>
        asked.push({
          input,
          async answer(more = {}) {
            const { t } = input;
            const empty = { values: [], robots: [], objects: [], nodes: [], events: [] };
            resolve({ run: 1, t, to: 100, ...empty, ...more });
            await new Promise(setImmediate);
          },
        }),
      );
    },
  } as unknown as Connection;
  const topics = { get: () => history } as unknown as TopicCache;
  return { past: new Past(connection, topics, () => [[3, 40, 2]]), asked, history };
}

describe('the past', () => {
  it('is asked for the newest wish only', async () => {
    const { past, asked } = aPast();
    for (const t of [50, 51, 52]) past.look(t);
    expect(asked.map(({ input }) => input.t)).toEqual([50]);
    await asked[0]?.answer();
    expect(past.instant?.t).toBe(50);
    expect(past.shown).toBe(50);
    expect(asked.map(({ input }) => input.t)).toEqual([50, 52]);
    await asked[1]?.answer();
    expect(past.shown).toBe(past.at);
  });

  it('stays within what is kept', () => {
    const { past } = aPast();
    past.look(500);
    expect(past.at).toBe(100);
    past.look(0);
    expect(past.at).toBe(10);
  });

  it('steps in round parts of a second', () => {
    const { past } = aPast();
    past.look(50);
    for (let i = 0; i < 3; i++) past.step(0.02);
    expect(past.at).toBe(50.06);
    past.step(-0.02);
    expect(past.at).toBe(50.04);
  });

  it('knows words as they were, and what is not recorded', async () => {
    const { past, asked } = aPast();
    past.look(50);
    const words: Json[] = [7, null];
    await asked[0]?.answer({ values: [{ node: 3, address: 40, words }] });
    expect(past.value(3, 40)).toBe(7);
    expect(past.value(3, 41)).toBeUndefined();
    expect(past.value(4, 40)).toBeUndefined();
  });

  it('takes a plan that is one, and no other', async () => {
    const { past, asked } = aPast();
    past.look(50);
    const plan = { state: 'running', t: 50, levels: [], story: [] };
    await asked[0]?.answer({ plan });
    expect(past.plan?.state).toBe('running');
    past.look(51);
    await asked[1]?.answer({ plan: { ...plan, levels: 7 } });
    expect(past.plan).toBeNull();
  });

  it('is over when the person comes back, though an answer is under way', async () => {
    const { past, asked } = aPast();
    past.look(50);
    past.back();
    await asked[0]?.answer();
    expect(past.at).toBeNull();
    expect(past.instant).toBeNull();
  });

  it('goes to the steps of the plan', async () => {
    const { past, asked } = aPast();
    past.look(50);
    await asked[0]?.answer();
    const done = past.stepOfPlan(true);
    await asked[1]?.answer({ next: 61.5 });
    await done;
    expect(past.at).toBe(61.5);
  });

  it('goes to the end behind the last step of the plan, to the beginning before the first', async () => {
    const { past, asked } = aPast();
    past.look(50);
    await asked[0]?.answer();
    for (const [forward, to] of [
      [true, past.end],
      [false, past.start],
    ] as const) {
      const done = past.stepOfPlan(forward);
      await asked.at(-1)?.answer({});
      await done;
      expect(past.at).toBe(to);
    }
  });

  it('ends when another run begins', () => {
    const { past, history } = aPast();
    past.told();
    past.look(50);
    past.told();
    expect(past.at).toBe(50);
    history.run = 2;
    past.told();
    expect(past.at).toBeNull();
  });

  it('of a trace that is opened is that of its file', async () => {
    const { past, asked, history } = aPast();
    past.told();
    await past.openTrace('a.trace.jsonl');
    expect([past.at, past.start, past.end]).toEqual([2, 2, 7]);
    expect(asked[0]?.input.trace).toBe('a.trace.jsonl');
    history.run = 2;
    past.told();
    expect(past.at).toBe(2);
    past.back();
    expect([past.at, past.trace]).toEqual([null, null]);
  });

  it('of a recording of several robots is asked for one of them', async () => {
    const { past, asked } = aPast();
    await past.openTrace('run.mcap', 'r2', 6);
    expect(past.at).toBe(6);
    expect(past.asked).toEqual({ trace: 'run.mcap', robot: 'r2' });
    expect(asked[0]?.input).toMatchObject(past.asked);
  });
});
