// The trails of a run: what was not seen comes from the history.
import { describe, expect, test } from 'vitest';
import type { Json } from '../../protocol/messages';
import { Ways } from './ways';

function theWays(answer: Json[][]) {
  const asked: { from: number; to: number }[] = [];
  const ways = new Ways((input) => {
    asked.push(input);
    return Promise.resolve({ run: 1, ways: answer.shift() ?? [] });
  });
  const frame = (t: number, x: number) => {
    ways.frame(t, ['anna']);
    ways.trails.at(t);
    ways.trails.add('anna', { x, y: 0 });
  };
  return { ways, asked, frame, xs: () => ways.trails.of('anna').map((point) => point.x) };
}
const settled = () => new Promise((resolve) => setTimeout(resolve));

describe('trails of a run', () => {
  test('AfterAReloadTheyAreAskedFromTheHistoryOnce', async () => {
    const { asked, frame, xs } = theWays([[[0, 1, 0.1, 0, 2, 0.2, 0]]]);
    frame(3, 0.3);
    frame(3.03, 0.32);
    await settled();
    expect(asked).toEqual([{ from: 0, to: 3 }]);
    expect(xs()).toEqual([0.1, 0.2, 0.3, 0.32]);
  });

  test('WhileAnotherPanelWasInFrontTheGapIsFilled', async () => {
    const { asked, frame, xs } = theWays([[[0, 1, 0.2, 0, 4, 0.4, 0]]]);
    frame(0.1, 0.1);
    frame(5, 0.5);
    await settled();
    expect(asked).toEqual([{ from: 0.1, to: 5 }]);
    expect(xs()).toEqual([0.1, 0.2, 0.4, 0.5]);
  });

  test('ClearedTrailsDoNotComeBack', async () => {
    const { ways, asked, frame, xs } = theWays([[[0, 1, 0.1, 0]], [[0, 6, 0.6, 0]]]);
    frame(3, 0.3);
    ways.clear();
    await settled();
    expect(xs()).toEqual([]);
    frame(7, 0.7);
    await settled();
    expect(asked.at(-1)).toEqual({ from: 3, to: 7 });
    expect(xs()).toEqual([0.6, 0.7]);
  });

  test('BackAtTheStartTheyBeginAgain', async () => {
    const { asked, frame, xs } = theWays([]);
    frame(0.2, 0.2);
    frame(0.4, 0.4);
    frame(0, 0);
    await settled();
    expect(asked).toEqual([]);
    expect(xs()).toEqual([0]);
  });
});
