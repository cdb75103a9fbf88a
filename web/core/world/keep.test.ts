// What a hand did in a run, kept in the file of the world.
import { describe, expect, test } from 'vitest';
import type { Json } from '../../protocol/messages';
import { applySteps } from '../json_steps';
import { Hand, type Deed, type HandObject } from './hand';
import { keepSteps } from './keep';

const file: Json = {
  format: 'vagus-world/1',
  size: [4, 3],
  robots: [{ name: 'anna', type: 'epuck', at: [1, 1], angle: 4 }],
  objects: [
    { kind: 'box', at: [2, 1], size: [0.2, 0.2] },
    { id: 'post', kind: 'cylinder', at: [3, 1], radius: 0.1 },
    { kind: 'box', at: [2, 2], size: [0.2, 0.2] },
    { id: 'lamp', kind: 'light', at: [0.5, 0.5] },
  ],
  timeline: [
    { t: 2, do: 'move', id: 'post', at: [3, 2] },
    { t: 3, do: 'add', object: { id: 'late', kind: 'box', at: [1, 2], size: [0.3, 0.3] } },
    { t: 4, do: 'remove', id: 'post' },
  ],
};

const pose = (x: number, y: number, angle = 0) => ({ x, y, angle });
const object = (id: string, more: Partial<HandObject>): HandObject => ({
  id,
  kind: 'box',
  size: [0.2, 0.2],
  height: 0.1,
  mass: 0,
  colour: [0.9, 0.9, 0.9],
  on: true,
  pose: pose(0, 0),
  ...more,
});

function kept(deeds: Deed[], of: Json = file) {
  const hand = new Hand(() => Promise.reject(new Error('not asked')));
  deeds.forEach((deed) => hand.note(deed));
  const keeping = keepSteps(of, hand.changes());
  const value = applySteps(of, keeping.steps).value as Record<string, Json[]>;
  // All of it is kept: nothing is left to do.
  hand.keep(keeping.kept, null);
  expect(keepSteps(value, hand.changes()).steps).toEqual([]);
  return { steps: keeping.steps, value };
}

const put: Deed = {
  is: 'put',
  number: 5,
  object: object('', { kind: 'cylinder', radius: 0.1, pose: pose(1.23456, 2, 0) }),
};

describe('Keep in the world', () => {
  test('ARobotStartsWhereAHandPutItAndItsAngleStaysIfItLooksThatWay', () => {
    // 4 rad, and a turn less.
    const to = pose(1.5, 1, 4 - 2 * Math.PI);
    expect(kept([{ is: 'robot', name: 'anna', from: pose(3, 3), to }]).steps).toEqual([
      { do: 'set', at: ['robots', 0, 'at'], value: [1.5, 1] },
    ]);
  });

  test('AnObjectWithoutANameIsTheOneThatStoodThere', () => {
    const from = object('', { pose: pose(2, 2) });
    // Its number would mean the first: the file has changed since the world was opened.
    const { steps } = kept([{ is: 'move', number: 1, object: from, to: pose(2.5, 2) }]);
    expect(steps).toEqual([{ do: 'set', at: ['objects', 2, 'at'], value: [2.5, 2] }]);
  });

  test('OneThatWasPushedIsTheOneOfItsNumber', () => {
    const from = object('', { pose: pose(2.2, 1.1) });
    const { steps } = kept([{ is: 'move', number: 3, object: from, to: pose(2.5, 2) }]);
    expect(steps).toEqual([{ do: 'set', at: ['objects', 2, 'at'], value: [2.5, 2] }]);
  });

  test('WhatWasPutGetsANameAndOnlyWhatIsNotUsual', () => {
    expect(kept([put]).steps).toEqual([
      {
        do: 'insert',
        at: ['objects', 4],
        value: { id: 'cylinder', kind: 'cylinder', at: [1.2346, 2], radius: 0.1 },
      },
    ]);
  });

  test('WhatWasPutKeptAndMovedIsMovedInTheFile', () => {
    const hand = new Hand(() => Promise.reject(new Error('not asked')));
    hand.note(put);
    const first = keepSteps(file, hand.changes());
    hand.keep(first.kept, null);
    const value = applySteps(file, first.steps).value;
    hand.note({ is: 'move', number: 5, object: put.object, to: pose(3, 2) });
    const then = keepSteps(value, hand.changes());
    expect(then.steps).toEqual([{ do: 'set', at: ['objects', 4, 'at'], value: [3, 2] }]);
    // Undo in Edit has taken it out of the file: it can be kept again.
    expect(keepSteps(file, hand.changes()).kept.size).toBe(1);
  });

  test('WhatWasTakenGoesWithAllThatTheTimelineWouldDoToIt', () => {
    const post = object('post', { kind: 'cylinder', radius: 0.1, pose: pose(3, 1) });
    const { value } = kept([{ is: 'take', number: 2, object: post }]);
    expect(value['objects']).toHaveLength(3);
    expect(value['timeline']?.map((one) => (one as { do: string }).do)).toEqual(['add']);
    const late = object('late', { pose: pose(1, 2) });
    const without = kept([{ is: 'take', number: 5, object: late }]).value;
    expect(without['timeline']?.map((one) => (one as { do: string }).do)).toEqual([
      'move',
      'remove',
    ]);
  });

  test('WhatTheTimelineAddsIsMovedThere', () => {
    const late = object('late', { pose: pose(1, 2) });
    expect(kept([{ is: 'move', number: 5, object: late, to: pose(1.5, 2) }]).steps).toEqual([
      { do: 'set', at: ['timeline', 1, 'object', 'at'], value: [1.5, 2] },
    ]);
  });

  test('ALampThatIsOffIsSwitchedOffAtTheStart', () => {
    const lamp = object('lamp', { kind: 'light', pose: pose(0.5, 0.5) });
    const off = kept([{ is: 'light', number: 4, object: lamp, on: false }]);
    expect(off.steps).toEqual([
      { do: 'insert', at: ['timeline', 0], value: { t: 0, do: 'light', id: 'lamp', on: false } },
    ]);
    const on = kept(
      [{ is: 'light', number: 4, object: { ...lamp, on: false }, on: true }],
      off.value,
    );
    expect(on.value).toEqual(file);
  });

  test('SeveralAtOnceAreOneChange', () => {
    const first = object('', { pose: pose(2, 1) });
    const { value } = kept([
      { is: 'take', number: 1, object: first },
      { is: 'move', number: 2, object: object('post', { kind: 'cylinder' }), to: pose(1, 2.5) },
      put,
    ]);
    expect(value['objects']).toMatchObject([
      { id: 'post', at: [1, 2.5] },
      { kind: 'box', at: [2, 2] },
      { id: 'lamp' },
      { id: 'cylinder' },
    ]);
  });

  test('WhatTheFileLacksIsLeftOut', () => {
    expect(kept([{ is: 'robot', name: 'bob', from: pose(1, 1), to: pose(2, 2) }]).steps).toEqual(
      [],
    );
  });
});
