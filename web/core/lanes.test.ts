import { describe, expect, it } from 'vitest';
import type { Connection } from './connection';
import { LanesFeed } from './lanes';

const wish = (to: number) => ({ from: 0, to, width: 100 });

function aFeed(answers: (() => Promise<unknown>)[]) {
  const asked: number[] = [];
  const timers: (() => void)[] = [];
  const send = (_command: string, input: { to: number }) => {
    asked.push(input.to);
    return answers.shift()?.() ?? Promise.resolve({ to: input.to });
  };
  const feed = new LanesFeed({ send } as unknown as Connection, (_ms, act) => {
    timers.push(act);
    return () => {};
  });
  const settle = () => new Promise(setImmediate);
  return { feed, asked, timers, settle };
}

describe('the lanes of a timeline', () => {
  it('are asked for the newest wish, once the one before was answered and a moment has passed', async () => {
    const { feed, asked, timers, settle } = aFeed([]);
    for (const to of [1, 2, 3]) feed.want(wish(to));
    await settle();
    expect(asked).toEqual([1]);
    expect(feed.span).toEqual({ from: 0, to: 1 });
    timers.shift()?.();
    await settle();
    expect(asked).toEqual([1, 3]);
  });

  it('are not asked again for the same, nor when nobody looks', async () => {
    const { feed, asked, timers, settle } = aFeed([]);
    feed.want(wish(1));
    await settle();
    feed.want(wish(1));
    timers.shift()?.();
    feed.want(null);
    await settle();
    expect(asked).toEqual([1]);
    // Until more is known of the same seconds.
    feed.want(wish(1), 'until 0.5 s');
    await settle();
    expect(asked).toEqual([1, 1]);
  });

  it('say why there are none, and come when there are', async () => {
    const { feed, asked, timers, settle } = aFeed([
      () => Promise.reject(new Error('nothing has run yet')),
    ]);
    feed.want(wish(1));
    await settle();
    expect([feed.lanes, feed.problem]).toEqual([null, 'nothing has run yet']);
    feed.want(wish(2));
    timers.shift()?.();
    await settle();
    expect(asked).toEqual([1, 2]);
    expect(feed.problem).toBeNull();
  });
});
