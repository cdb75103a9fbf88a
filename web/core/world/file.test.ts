import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import type { Json, JsonStep } from '../../protocol/messages';
import { applySteps } from '../json_steps';
import {
  copySteps,
  entryOf,
  freeName,
  keyMeant,
  kindSteps,
  moveSteps,
  newEntry,
  newObject,
  newRobot,
  removeSteps,
  setSteps,
  shapeSteps,
  stageOfFile,
  tableAt,
  timeSteps,
  verbSteps,
} from './file';

const file: Json = {
  format: 'vagus-world/1',
  size: [6, 4.5],
  objects: [
    { id: 'pier', kind: 'wall', at: [3.6, 0.4], size: [0.5, 0.8] },
    { kind: 'patch', at: [1, 1], radius: 0.2 },
  ],
  robots: [{ name: 'carbot', type: 'carbot', at: [0.8, 1.9], angle: -1.1, node: 5 }],
  timeline: [
    { t: 52, do: 'add', object: { id: 'box', kind: 'box', at: [5.5, 2.8], size: [0.4, 0.4] } },
    { t: 92, do: 'remove', id: 'box' },
  ],
};
const after = (steps: JsonStep[]) => applySteps(file, steps).value;

describe('the file of a world', () => {
  test('EveryExampleCanBeShown', () => {
    for (const path of [
      'follow-wall/hall',
      'rooms/flat',
      'thymio/arena',
      'thymio/line',
      'epuck/colours',
      'infrared/room',
    ]) {
      const text = readFileSync(`../examples/${path}.world.json`, 'utf8');
      const world = JSON.parse(text) as { objects: unknown[]; robots: unknown[] };
      const now = stageOfFile(world as unknown as Json).things.filter((thing) => !thing.later);
      expect(now).toHaveLength(world.objects.length + world.robots.length);
    }
  });
  test('AGridIsShownAsItsRobots', () => {
    const entry = { name: 't', type: 'thymio2', at: [1, 2], grid: [3, 2], spacing: [0.5, 1] };
    const world: Json = { size: [9, 9], robots: [entry, { ...entry, name: 'u', grid: [2, 1] }] };
    const things = stageOfFile(world).things;
    expect(things.map((one) => one.name)).toEqual('t1 t2 t3 t4 t5 t6 u1 u2'.split(' '));
    expect(things[4]).toMatchObject({ key: 'robots/0/4', pose: { x: 1.5, y: 3 } });
    expect(things[6]?.key).toBe('robots/1');
    expect(new Set(things.map((one) => one.key)).size).toBe(8);
    expect(freeName(world, 't1')).not.toBe('t1');
  });
  test('WhatCannotBeReadIsLeftOut', () => {
    const stage = stageOfFile({ size: 'large', objects: [{ kind: 'ghost', at: [1, 1] }, 7] });
    expect(stage).toMatchObject({ width: 1, height: 1, things: [] });
    expect(stageOfFile(null).things).toEqual([]);
  });
  test('WhatComesLaterIsShownAsThat', () => {
    const later = stageOfFile(file).things.filter((thing) => thing.later);
    expect(later.map((thing) => [thing.key, thing.name])).toEqual([['timeline/0', 'box']]);
  });
  test('MovingWritesRoundNumbersAndOnlyWhatChanges', () => {
    expect(moveSteps(file, 'robots/0', { x: 1.00001, y: 2, angle: -1.1 })).toEqual([
      { do: 'set', at: ['robots', 0, 'at'], value: [1, 2] },
    ]);
    expect(moveSteps(file, 'timeline/0', { x: 5.5, y: 2.8, angle: 0.5 })).toEqual([
      { do: 'set', at: ['timeline', 0, 'object', 'angle'], value: 0.5 },
    ]);
    expect(moveSteps(file, 'objects/0', { x: 3.6, y: 0.4, angle: 0 })).toEqual([]);
    expect(moveSteps(file, 'objects/9', { x: 3.6, y: 0.4, angle: 0 })).toEqual([]);
  });
  test('MembersAreSetAndTakenOut', () => {
    expect(setSteps(file, 'robots/0', 'node', undefined)).toEqual([
      { do: 'remove', at: ['robots', 0, 'node'] },
    ]);
    expect(setSteps(file, null, 'open', true)).toEqual([{ do: 'set', at: ['open'], value: true }]);
    expect(setSteps(file, null, 'open', undefined)).toEqual([]);
  });
  test('ASizeBecomesARadiusAndBack', () => {
    const round = after(shapeSteps(file, 'objects/0', true));
    expect(tableAt(round, 'objects/0')).toMatchObject({ radius: 0.25 });
    expect(tableAt(round, 'objects/0')['size']).toBeUndefined();
    const flat = applySteps(file, shapeSteps(file, 'objects/1', false)).value;
    expect(tableAt(flat, 'objects/1')).toMatchObject({ size: [0.4, 0.4] });
  });
  test('AnotherKindGetsWhatItNeeds', () => {
    expect(tableAt(after(kindSteps(file, 'objects/0', 'cylinder')), 'objects/0')).toMatchObject({
      kind: 'cylinder',
      radius: 0.25,
    });
    expect(tableAt(after(kindSteps(file, 'objects/1', 'box')), 'objects/1')).toMatchObject({
      kind: 'box',
      size: [0.4, 0.4],
    });
  });
  test('NewThingsHaveNamesOfTheirOwn', () => {
    expect(freeName(file, 'pier')).toBe('pier2');
    expect(freeName(file, 'box')).toBe('box2');
    const added = newObject(file, 'box', { x: 1, y: 1, angle: 0 });
    expect(added.key).toBe('objects/2');
    expect(tableAt(after(added.steps), added.key)).toEqual({
      id: 'box2',
      kind: 'box',
      at: [1, 1],
      size: [0.2, 0.2],
    });
    const robot = newRobot(file, 'carbot', { x: 1, y: 1, angle: 1 });
    expect(tableAt(after(robot.steps), robot.key)).toMatchObject({ name: 'carbot2', angle: 1 });
  });
  test('AFileWithoutAListGetsOne', () => {
    const bare: Json = { format: 'vagus-world/1', size: [1, 1] };
    const { steps } = newObject(bare, 'wall', { x: 0.5, y: 0.5, angle: 0 });
    expect(applySteps(bare, steps).value).toMatchObject({ objects: [{ kind: 'wall' }] });
  });
  test('ACopyHasNoNodeOfTheFirst', () => {
    const copied = copySteps(file, 'robots/0');
    const robot = copied && tableAt(after(copied.steps), copied.key);
    expect(robot).toMatchObject({ name: 'carbot2', at: [0.9, 1.8] });
    expect(robot?.['node']).toBeUndefined();
  });
  test('TakingAwayIsTakenBack', () => {
    const { value, undo } = applySteps(file, removeSteps(file, 'objects/0'));
    expect(stageOfFile(value).things).toHaveLength(3);
    expect(applySteps(value, undo).value).toEqual(file);
  });
  test('EntriesStandInTheOrderOfTime', () => {
    const added = newEntry(file, 60, 'press');
    expect(added.key).toBe('timeline/1');
    expect(entryOf(after(added.steps), added.key)).toEqual({
      t: 60,
      do: 'press',
      robot: 'carbot',
      button: 'escape',
    });
    const timed = timeSteps(file, 'timeline/0', 100);
    expect(timed?.key).toBe('timeline/1');
    expect(timed && entryOf(after(timed.steps), 'timeline/0')).toMatchObject({ do: 'remove' });
    expect(timed && entryOf(after(timed.steps), 'timeline/1')).toMatchObject({ t: 100, do: 'add' });
  });
  test('AFindingLeadsToItsThing', () => {
    expect(keyMeant('robots[0].at: robot carbot would overlap the wall')).toBe('robots/0');
    expect(keyMeant('timeline[12].t')).toBe('timeline/12');
    expect(keyMeant('size: too large')).toBeNull();
  });
  test('AnotherVerbKeepsWhatBothNeed', () => {
    expect(entryOf(after(verbSteps(file, 'timeline/1', 'move')), 'timeline/1')).toEqual({
      t: 92,
      do: 'move',
      id: 'box',
      at: [3, 2.25],
    });
  });
});
