import { expect, test } from 'vitest';
import type { Studio } from '../../core/studio';
import { createWindowStore } from '../../core/window_state';
import { orderNodes } from './run_commands';

/** A studio whose server refuses for so many nodes. */
const refusing = (nodes: number) =>
  ({
    window: createWindowStore(),
    topics: { get: () => null },
    inTurn: (ready: Promise<unknown>, send: () => unknown) => ready.then(send),
    send: () =>
      Promise.resolve({
        failed: Array.from({ length: nodes }, (_, at) => ({ node: at + 1, why: 'is running' })),
        notes: [],
      }),
  }) as unknown as Studio;

const said = async (nodes: number) => {
  const studio = refusing(nodes);
  await orderNodes(studio, 'step', []);
  return studio.window.getState().toasts.map(({ text }) => text);
};

test('three nodes that did not do it say why, of more their number is told', async () => {
  const three = ['1: is running', '2: is running', '3: is running'];
  expect(await said(3)).toEqual(three);
  expect(await said(4)).toEqual([...three, '1 more node did not do it.']);
  expect(await said(100)).toEqual([...three, '97 more nodes did not do it.']);
});
