// When something in a run was decided: the curve of the answer, as it is drawn. Pure.

import type { Topics, TurningPoint } from '../protocol/messages';

export type Deciding = Topics['turning']['is'];

export interface Size {
  width: number;
  height: number;
}

/** One instant of the curve in a chart: 0 at its left, and at its top. */
export interface DrawnPoint {
  x: number;
  y: number;
  low: number;
  high: number;
  point: TurningPoint;
}

export const shareOf = ({ came, of }: TurningPoint): number => (of === 0 ? 0 : came / of);

/** In how many continuations it became true, over the instants from which they were continued. */
export function drawnCurve(
  curve: readonly TurningPoint[],
  until: number,
  { width, height }: Size,
): DrawnPoint[] {
  const place = (share: number) => height * (1 - share);
  return curve.map((point) => ({
    x: until > 0 ? (point.t / until) * width : 0,
    y: place(shareOf(point)),
    low: place(point.end ? shareOf(point) : point.low),
    high: place(point.end ? shareOf(point) : point.high),
    point,
  }));
}

/** Its line, and around it the chance that the shares say, with 95 % confidence. */
export function curvePaths(points: readonly DrawnPoint[]): { line: string; band: string } {
  const path = (places: readonly (readonly [number, number])[]) =>
    places.map(([x, y], at) => `${at === 0 ? 'M' : 'L'}${x.toFixed(1)} ${y.toFixed(1)}`).join('');
  const top = points.map(({ x, high }) => [x, high] as const);
  const bottom = points.map(({ x, low }) => [x, low] as const).reverse();
  return {
    line: path(points.map(({ x, y }) => [x, y] as const)),
    band: points.length > 1 ? `${path([...top, ...bottom])}Z` : '',
  };
}

/** The point of the curve nearest to a place in the chart; null: there is none. */
export function nearestPoint(points: readonly DrawnPoint[], x: number): DrawnPoint | null {
  return points.reduce<DrawnPoint | null>(
    (best, one) => (best === null || Math.abs(one.x - x) < Math.abs(best.x - x) ? one : best),
    null,
  );
}
