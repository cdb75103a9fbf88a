import { describe, expect, it } from 'vitest';
import {
  curvePath,
  movedSpan,
  newestSpan,
  placeIn,
  spanWith,
  ticksOf,
  timeAt,
  wholeSpan,
  zoomedSpan,
} from './timeline';

describe('the span of a timeline', () => {
  it('shows the newest half minute, from the start at first', () => {
    expect(newestSpan(0, 12)).toEqual({ from: 0, to: 30 });
    expect(newestSpan(0, 99.2)).toEqual({ from: 69.2, to: 99.2 });
  });

  it('shows all that is kept, with room at the end', () => {
    expect(wholeSpan(0, 100)).toEqual({ from: 0, to: 102 });
    expect(wholeSpan(5, 5).to).toBeGreaterThan(5);
  });

  it('zooms around an instant, which stays where it is', () => {
    const before = { from: 10, to: 30 };
    const after = zoomedSpan(before, 15, 0.5);
    expect(after).toEqual({ from: 12.5, to: 22.5 });
    expect(placeIn(after, 15, 400)).toBe(placeIn(before, 15, 400));
    // Neither below 0 s, nor to nothing, nor without end.
    expect(zoomedSpan({ from: 0, to: 10 }, 5, 4)).toEqual({ from: 0, to: 40 });
    expect(zoomedSpan(before, 20, 1e-9).to - zoomedSpan(before, 20, 1e-9).from).toBeCloseTo(0.05);
    expect(zoomedSpan(before, 20, 1e9).to).toBe(7200);
  });

  it('moves, but not before the start', () => {
    expect(movedSpan({ from: 10, to: 30 }, 5)).toEqual({ from: 15, to: 35 });
    expect(movedSpan({ from: 10, to: 30 }, -50)).toEqual({ from: 0, to: 20 });
  });

  it('brings an instant into sight, in its middle', () => {
    const span = { from: 10, to: 30 };
    expect(spanWith(span, 30)).toBe(span);
    expect(spanWith(span, 50)).toEqual({ from: 40, to: 60 });
    expect(spanWith(span, 2)).toEqual({ from: 0, to: 20 });
  });

  it('knows where a second is, and back', () => {
    expect(placeIn({ from: 10, to: 30 }, 15, 800)).toBe(200);
    expect(timeAt({ from: 10, to: 30 }, 200, 800)).toBe(15);
  });
});

describe('the ruler', () => {
  it('has round instants, far enough apart', () => {
    // 30 s on 900 px: 90 px are 3 s; the next round step is 5 s.
    expect(ticksOf({ from: 69.2, to: 99.2 }, 900)).toEqual([70, 75, 80, 85, 90, 95]);
    expect(ticksOf({ from: 0, to: 1 }, 900)).toEqual([
      0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1,
    ]);
    expect(ticksOf({ from: 0, to: 3600 }, 900)).toEqual([
      0, 500, 1000, 1500, 2000, 2500, 3000, 3500,
    ]);
  });
});

describe('a curve', () => {
  it('goes through the lowest and highest values, and stops where nothing is known', () => {
    // -10 to 10 on 20 px: a pixel is 1. Columns of 10 px: their middles are 5, 15, 35.
    const curve = curvePath([0, -10, null, 10], [0, 10, null, 10], 20, (column) => column * 10);
    expect(curve).toEqual({
      line: 'M5.0 10.0L15.0 20.0L15.0 0.0M35.0 0.0',
      least: -10,
      most: 10,
    });
    expect(curvePath([null], [null], 20, (column) => column)).toBeNull();
  });

  it('shows zero, also where no value comes near it', () => {
    expect(curvePath([5], [7], 7, (column) => column * 10)).toEqual({
      line: 'M5.0 2.0L5.0 0.0',
      least: 0,
      most: 7,
    });
  });
});
