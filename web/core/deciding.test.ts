import { expect, test } from 'vitest';
import { curvePaths, drawnCurve, nearestPoint } from './deciding';

const curve = [
  { t: 0, came: 10, of: 20, low: 0.3, high: 0.7, end: false },
  { t: 5, came: 20, of: 20, low: 0.84, high: 1, end: false },
  { t: 10, came: 20, of: 20, low: 0.84, high: 1, end: true },
];

test('a curve goes from its beginning to its end, all of them at the top', () => {
  const points = drawnCurve(curve, 10, { width: 200, height: 100 });
  expect(points.map(({ x, y }) => [x, y])).toEqual([
    [0, 50],
    [100, 0],
    [200, 0],
  ]);
  // Of the end everything is known.
  expect(points.map(({ low, high }) => [Math.round(low), Math.round(high)])).toEqual([
    [70, 30],
    [16, 0],
    [0, 0],
  ]);
  const { line, band } = curvePaths(points);
  expect(line).toBe('M0.0 50.0L100.0 0.0L200.0 0.0');
  expect(band).toBe('M0.0 30.0L100.0 0.0L200.0 0.0L200.0 0.0L100.0 16.0L0.0 70.0Z');
});

test('what has no length, or nothing in it, is drawn all the same', () => {
  expect(drawnCurve(curve.slice(0, 1), 0, { width: 200, height: 100 })[0]?.x).toBe(0);
  expect(curvePaths([])).toEqual({ line: '', band: '' });
  expect(nearestPoint([], 3)).toBeNull();
});

test('a place in the chart means the point that is nearest', () => {
  const points = drawnCurve(curve, 10, { width: 200, height: 100 });
  expect(nearestPoint(points, 149)?.point.t).toBe(5);
  expect(nearestPoint(points, 151)?.point.t).toBe(10);
});
