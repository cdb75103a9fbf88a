// Places and angles that a hand means: on the grid, in round numbers.

import { normalAngle, radians, type Point } from './geometry';

export const kSnapM = 0.05;
export const kSnapAngle = radians(15);
/** Numbers in files: a tenth of a millimetre, a ten-thousandth of a radian. */
const kDecimals = 4;

export function snapPoint(point: Point, step: number): Point {
  return { x: tidy(snapped(point.x, step)), y: tidy(snapped(point.y, step)) };
}

export function snapAngle(angle: number, step: number): number {
  return tidy(normalAngle(snapped(angle, step)));
}

/** Without the digits that computing adds. */
export function tidy(value: number): number {
  const power = 10 ** kDecimals;
  return Math.round(value * power) / power + 0;
}

function snapped(value: number, step: number): number {
  return step > 0 ? Math.round(value / step) * step : value;
}
