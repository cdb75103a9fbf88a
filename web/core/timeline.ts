// The arithmetic of a timeline: which seconds are in sight, where a second is, what its ruler
// says. Pure.

import type { Commands } from '../protocol/messages';
import type { Span } from './ring';

export type Lanes = Commands['history.lanes']['out'];

/** Seconds that are in sight at first, while the newest are followed. */
export const kFollowSpan = 30;
export const kSpanLeast = 0.05;
export const kSpanMost = 2 * 3600;

/** The newest seconds; at the start of a run the axis is as long as later on. */
export function newestSpan(from: number, to: number, span = kFollowSpan): Span {
  const end = Math.max(to, from + span);
  return { from: end - span, to: end };
}

/** Everything that is kept, with some room at its end. */
export function wholeSpan(from: number, to: number): Span {
  const length = Math.max(to - from, kSpanLeast);
  return { from, to: from + length * 1.02 };
}

/** Larger (factor below 1) or smaller around an instant, which keeps its place. */
export function zoomedSpan({ from, to }: Span, around: number, factor: number): Span {
  const length = Math.min(Math.max((to - from) * factor, kSpanLeast), kSpanMost);
  const part = (around - from) / (to - from);
  const start = Math.max(0, around - part * length);
  return { from: start, to: start + length };
}

export function movedSpan({ from, to }: Span, by: number): Span {
  const start = Math.max(0, from + by);
  return { from: start, to: start + (to - from) };
}

/** The same length, so that the instant is in sight; the span itself if it is already. */
export function spanWith(span: Span, t: number): Span {
  if (t >= span.from && t <= span.to) return span;
  return movedSpan(span, t - (span.from + span.to) / 2);
}

export function placeIn({ from, to }: Span, t: number, width: number): number {
  return ((t - from) / (to - from)) * width;
}

export function timeAt({ from, to }: Span, place: number, width: number): number {
  return from + (place / width) * (to - from);
}

const kSteps = [1, 2, 5] as const;

/** Round instants of a ruler, at least so many pixels apart. */
export function ticksOf({ from, to }: Span, width: number, apart = 90): number[] {
  const least = ((to - from) * apart) / Math.max(width, 1);
  const power = 10 ** Math.floor(Math.log10(least));
  const step = kSteps.map((one) => one * power).find((one) => one >= least) ?? 10 * power;
  const first = Math.ceil(from / step - 1e-9);
  const count = Math.floor(to / step + 1e-9) - first + 1;
  return Array.from({ length: Math.max(0, count) }, (_, index) =>
    Number(((first + index) * step).toPrecision(12)),
  );
}

/** A curve of lowest and highest values as an area and a line, 0 at the top; null: nothing known. */
export interface CurvePath {
  line: string;
  least: number;
  most: number;
}

export function curvePath(
  low: readonly unknown[],
  high: readonly unknown[],
  height: number,
  /** Where the middle of a column is. */
  placeOf: (column: number) => number,
): CurvePath | null {
  const numbers = [...low, ...high].filter((one) => typeof one === 'number');
  if (numbers.length === 0) return null;
  const least = numbers.reduce((a, b) => Math.min(a, b), 0);
  const most = numbers.reduce((a, b) => Math.max(a, b), 0);
  const range = most - least || 1;
  const y = (value: number) => (height - ((value - least) / range) * height).toFixed(1);
  let line = '';
  let drawing = false;
  high.forEach((top, index) => {
    const bottom = low[index] ?? top;
    if (typeof top !== 'number' || typeof bottom !== 'number') {
      drawing = false;
      return;
    }
    const x = placeOf(index + 0.5).toFixed(1);
    line += `${drawing ? 'L' : 'M'}${x} ${y(bottom)}`;
    if (top !== bottom) line += `L${x} ${y(top)}`;
    drawing = true;
  });
  return { line, least, most };
}
