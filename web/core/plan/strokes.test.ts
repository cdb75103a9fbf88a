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
