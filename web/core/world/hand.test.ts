// What a hand did in a run: undone, done again, and what is left of it.
import { describe, expect, test } from 'vitest';
import { Hand, kDeedsMax, type Deed, type HandObject } from './hand';

const pose = (x: number, angle = 0) => ({ x, y: 1, angle });

const box = (more: Partial<HandObject> = {}): HandObject => ({
  id: 'crate',
  kind: 'box',
  size: [0.2, 0.2],
  height: 0.1,
  mass: 1,
  colour: [1, 1, 1],
  on: true,
  pose: pose(1),
  ...more,
});

/** A server that does all, and gives numbers from 10 on. */
function aHand(fails: string[] = []) {
  const sent: [string, unknown][] = [];
  let number = 9;
  const hand = new Hand((command, input) => {
    sent.push([command, input]);
    if (fails.includes(command)) return Promise.reject(new Error('no'));
    return Promise.resolve({ number: ++number } as never);
  });
  return { hand, sent };
}

const drove: Deed = { is: 'robot', name: 'anna', from: pose(1), to: pose(2, 0.5) };

describe('a hand in a run', () => {
  test('UndoPutsARobotBackAndRedoThereAgain', async () => {
    const { hand, sent } = aHand();
    hand.note(drove);
    expect(hand.changes().map(({ robot, to }) => [robot, to.x])).toEqual([['anna', 2]]);
    await hand.undo();
    expect(hand.changes()).toEqual([]);
    await hand.redo();
    expect(hand.changes()).toHaveLength(1);
    expect(sent).toEqual([
      ['world.move', { robot: 'anna', at: [1, 1], angle: 0 }],
      ['world.move', { robot: 'anna', at: [2, 1], angle: 0.5 }],
    ]);
  });

  test('WhatWasTakenComesBackWithAllThatItHadAndIsKnownByItsNewNumber', async () => {
    const { hand, sent } = aHand();
    hand.note({ is: 'move', number: 4, object: box(), to: pose(3) });
    hand.note({ is: 'take', number: 4, object: box({ pose: pose(3) }) });
    expect(hand.changes().map(({ taken, from }) => [taken, from.x])).toEqual([[true, 1]]);
    await hand.undo();
    await hand.undo();
    expect(sent).toEqual([
      [
        'world.put',
        {
          id: 'crate',
          kind: 'box',
          size: [0.2, 0.2],
          height: 0.1,
          mass: 1,
          colour: [1, 1, 1],
          on: true,
          at: [3, 1],
          angle: 0,
        },
      ],
      ['world.move', { object: 10, at: [1, 1], angle: 0 }],
    ]);
  });

  test('WhatWasPutAndTakenAgainIsNoChange', () => {
    const { hand } = aHand();
    hand.note({ is: 'put', number: 7, object: box({ id: '' }) });
    expect(hand.changes().map((one) => one.put)).toEqual([true]);
    hand.note({ is: 'take', number: 7, object: box({ id: '' }) });
    expect(hand.changes()).toEqual([]);
  });

  test('KeysOfARowAreUndoneTogetherAndLaterOnesByThemselves', async () => {
    const { hand, sent } = aHand();
    const step = (from: number, at: number) =>
      hand.note(
        { is: 'robot', name: 'anna', from: pose(from), to: pose(from + 1) },
        { of: 'keys anna', at },
      );
    step(1, 0);
    step(2, 500);
    step(3, 5000);
    await hand.undo();
    await hand.undo();
    expect(hand.canUndo).toBe(false);
    expect(sent.map(([, input]) => (input as { at: number[] }).at[0])).toEqual([3, 1]);
  });

  test('WhatCannotBeUndoneIsSaidAndNotTriedAgain', async () => {
    const { hand } = aHand(['world.take']);
    const said: unknown[] = [];
    hand.failed.on((problem) => said.push(problem));
    hand.note({ is: 'put', number: 7, object: box({ id: '' }) });
    await hand.undo();
    expect(said).toHaveLength(1);
    expect([hand.canUndo, hand.canRedo]).toEqual([false, false]);
  });

  test('InAnotherWorldNothingCanBeUndoneAndAllCanStillBeKept', () => {
    const { hand } = aHand();
    hand.opened('1');
    hand.note(drove);
    hand.note({ is: 'put', number: 3, object: box({ id: '' }) });
    hand.opened('2');
    expect(hand.canUndo).toBe(false);
    expect(hand.isOfThisRun).toBe(false);
    // The number 3 is something else there.
    hand.note({ is: 'move', number: 3, object: box({ id: 'post' }), to: pose(4) });
    expect(hand.changes().map(({ object, put }) => [object?.id, put])).toEqual([
      [undefined, false],
      ['', true],
      ['post', false],
    ]);
    hand.forget();
    expect(hand.changes()).toEqual([]);
  });

  test('AReloadOfThePageForgetsNothingOfARunThatIsStillThere', async () => {
    const before = aHand().hand;
    before.opened('run 1');
    before.note(drove);
    before.note({ is: 'put', number: 7, object: box({ id: '' }) });
    before.note({ is: 'take', number: 7, object: box({ id: '' }) });
    await before.undo();
    const { hand, sent } = aHand();
    hand.restore(before.text());
    expect(hand.canUndo).toBe(false);
    // A page that is loaded again before it knew which world there is keeps it, too.
    expect(hand.text()).toBe(before.text());
    hand.opened('run 1');
    expect(hand.changes()).toEqual(before.changes());
    expect([hand.canUndo, hand.canRedo]).toEqual([true, true]);
    await hand.undo();
    await hand.undo();
    expect(sent).toEqual([
      ['world.take', { object: 10 }],
      ['world.move', { robot: 'anna', at: [1, 1], angle: 0 }],
    ]);
    const other = aHand().hand;
    other.restore(before.text());
    other.opened('run 2');
    expect([other.canUndo, other.canRedo, other.changes()]).toEqual([false, false, []]);
    const none = aHand().hand;
    none.restore(null);
    expect(none.text()).toBe('');
  });

  test('TheOldestDeedsAreForgottenAsUndoAndTheirChangesStay', async () => {
    const { hand, sent } = aHand();
    hand.note({ is: 'put', number: 7, object: box({ id: '' }) });
    for (let index = 0; index < kDeedsMax; index++)
      hand.note({ is: 'robot', name: 'anna', from: pose(index), to: pose(index + 1) });
    expect(hand.changes().map((one) => one.key)).toEqual(['object:7', 'robot:anna']);
    while (hand.canUndo) await hand.undo();
    expect(sent).toHaveLength(kDeedsMax);
    expect(hand.changes().map((one) => one.key)).toEqual(['object:7']);
  });

  test('ALampThatIsOnAgainIsNoChange', () => {
    const { hand } = aHand();
    const object = box({ id: 'lamp', kind: 'light' });
    hand.note({ is: 'light', number: 2, object, on: false });
    expect(hand.changes().map((one) => one.on)).toEqual([false]);
    hand.note({ is: 'light', number: 2, object: { ...object, on: false }, on: true });
    expect(hand.changes()).toEqual([]);
  });
});
