import { expect, test } from 'vitest';
import { nameSpot } from './strokes';

test('the name of an arrow is in the middle of its longest stretch', () => {
  const points = [
    { x: 0, y: 0 },
    { x: 40, y: 0 },
    { x: 40, y: 200 },
    { x: 100, y: 200 },
  ];
  expect(nameSpot({ id: 'a.Done', points })).toEqual({ x: 40, y: 100 });
});

test('an arrow without a way has no name on the canvas', () => {
  expect(nameSpot({ id: 'a.Done', points: [] })).toBeNull();
  expect(nameSpot({ id: 'a.Done', points: [{ x: 1, y: 1 }] })).toBeNull();
});

test('a name that is longer than its arrow covers no box', () => {
  // From a box of 168 by 92 to a tag: a stretch of 20 that begins at its right side, 81 below its top.
  const boxes = [{ x: 0, y: 0, width: 168, height: 92 }];
  const points = [
    { x: 168, y: 81 },
    { x: 188, y: 81 },
  ];
  const size = { width: 105, height: 20 };
  // To the right of the middle at 178, by half of 105 and 6.
  expect(nameSpot({ id: 'a.Done', points }, { size, boxes })).toEqual({ x: 236.5, y: 81 });
  // Where another box leaves no room beside it, it is below both: half of 20, 10 more and 6 below the middle.
  const beside = [...boxes, { x: 200, y: 0, width: 168, height: 92 }];
  expect(nameSpot({ id: 'a.Done', points }, { size, boxes: beside })).toEqual({ x: 178, y: 107 });
  // Where boxes are too high for that, it covers as little as can be: the last 13 rows of both.
  const high = [
    { x: 0, y: 0, width: 168, height: 140 },
    { x: 200, y: 0, width: 168, height: 140 },
  ];
  expect(nameSpot({ id: 'a.Done', points }, { size, boxes: high })).toEqual({ x: 178, y: 137 });
  // Without room on any side it is where it would be alone.
  const all = [{ x: -500, y: -500, width: 1500, height: 1500 }];
  expect(nameSpot({ id: 'a.Done', points }, { size, boxes: all })).toEqual({ x: 178, y: 81 });
});
