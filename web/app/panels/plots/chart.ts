// A plot drawn by uPlot: its options from what is plotted, its samples from the plotter.

import uPlot from 'uplot';
import type { Emitter } from '../../../core/emitter';
import type { Plotter } from '../../../core/plotter';
import { kAxes } from '../../../core/plot';
import { shownTime } from '../../../core/numbers';

/** The time that the pointer or the keys point at; null: none. */
export interface PlotCursor {
  time: number | null;
  moved: Emitter<void>;
}

/** Dashes tell curves apart where colours do not. */
export const dashes: readonly number[][] = [
  [],
  [6, 3],
  [2, 2],
  [8, 3, 2, 3],
  [12, 4],
  [4, 4],
  [1, 3],
  [10, 3, 2, 3, 2, 3],
];

/** Samples of a curve are thinned out to so many for each pixel. */
const kPointsPerPixel = 2;
const stepped = uPlot.paths.stepped?.({ align: 1 });
const kFont = '11px "Inter Variable", Inter, system-ui, sans-serif';

/** pastTime: the instant that is looked back at. */
export function makeChart(
  host: HTMLElement,
  plotter: Plotter,
  cursor: PlotCursor,
  pastTime: () => number | null,
): uPlot {
  const colour = coloursOf(host);
  const { curves } = plotter.state;
  const options: uPlot.Options = {
    width: Math.max(host.clientWidth, 60),
    height: Math.max(host.clientHeight, 40),
    legend: { show: false },
    padding: [8, curves.some((curve) => curve.axis % 2 === 0) ? 4 : 20, 0, 0],
    cursor: {
      points: { size: 6 },
      drag: { x: true, y: false, setScale: false },
      bind: { dblclick: () => () => (plotter.zoom(null), null) },
    },
    scales: {
      x: { time: false, range: () => [plotter.view().from, plotter.view().to] },
      ...Object.fromEntries(
        usedAxes(plotter).map((axis) => [`y${axis}`, { range: rangeOf } satisfies uPlot.Scale]),
      ),
    },
    axes: [
      axisOf(colour, { space: 70, size: 24, values: (_plot, ticks) => ticks.map(shownTick) }),
      ...usedAxes(plotter).map((axis, index) =>
        axisOf(colour, {
          scale: `y${axis}`,
          side: axis % 2 === 1 ? 3 : 1,
          size: 52,
          space: 26,
          grid: { show: index === 0, stroke: colour('--border-subtle'), width: 1 },
        }),
      ),
    ],
    series: [
      {},
      ...curves.map((curve): uPlot.Series => ({
        scale: `y${curve.axis}`,
        stroke: colour(`--curve-${curve.colour + 1}`),
        width: 1.5,
        dash: dashes[curve.colour] ?? [],
        spanGaps: true,
        points: { show: false },
        // A value holds until the next one comes.
        ...(stepped ? { paths: stepped } : {}),
      })),
    ],
    hooks: {
      draw: [(plot) => drawPast(plot, pastTime(), colour('--past'))],
      setCursor: [
        (plot) => {
          const { left } = plot.cursor;
          cursor.time = left === undefined || left < 0 ? null : plot.posToVal(left, 'x');
          cursor.moved.emit();
        },
      ],
      setSelect: [
        (plot) => {
          const { left, width } = plot.select;
          if (width < 4) return;
          plotter.zoom({
            from: plot.posToVal(left, 'x'),
            to: plot.posToVal(left + width, 'x'),
          });
          plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
        },
      ],
    },
  };
  return new uPlot(options, dataOf(plotter, options.width), host);
}

/** The cursor of all panels, as a line over the curves. */
function drawPast(plot: uPlot, at: number | null, colour: string): void {
  if (at === null) return;
  const x = plot.valToPos(at, 'x', true);
  const { left, top, width, height } = plot.bbox;
  if (x < left || x > left + width) return;
  const { ctx } = plot;
  ctx.save();
  ctx.strokeStyle = colour;
  ctx.lineWidth = 2;
  ctx.beginPath();
  ctx.moveTo(x, top);
  ctx.lineTo(x, top + height);
  ctx.stroke();
  ctx.restore();
}

export function dataOf(plotter: Plotter, width: number): uPlot.AlignedData {
  const { times, values, span } = plotter.data(width * kPointsPerPixel);
  // Up to now a curve is what it was last.
  const now = Math.min(span.to, plotter.newest);
  const last = times.at(-1) ?? -Infinity;
  const end = Math.max(now, last);
  if (now > last) {
    times.push(now);
    for (const column of values) column.push(null);
  }
  plotter.state.curves.forEach((curve, index) => {
    const column = values[index];
    if (column && times.length > 0)
      column[times.length - 1] ??= plotter.ring(curve).at(end) ?? null;
  });
  return [times, ...values];
}

export function usedAxes(plotter: Plotter): number[] {
  const used = new Set(plotter.state.curves.map((curve) => curve.axis));
  return Array.from({ length: kAxes }, (_, index) => index + 1).filter((axis) => used.has(axis));
}

/** The keys of a plot that has the focus: the cursor, the zoom. True if the key was one of them. */
export function pressPlot(plot: uPlot, plotter: Plotter, key: string): boolean {
  const { from, to } = plotter.view();
  const width = to - from;
  const middle = (from + to) / 2;
  switch (key) {
    case 'ArrowLeft':
    case 'ArrowRight': {
      const by = Math.max(1, plot.over.clientWidth / 100) * (key === 'ArrowLeft' ? -1 : 1);
      const now = plot.cursor.left ?? -1;
      const left = now < 0 ? plot.over.clientWidth : now;
      plot.setCursor({ left: clamp(left + by, plot.over.clientWidth), top: 1 });
      return true;
    }
    case '+':
      plotter.zoom({ from: middle - width / 4, to: middle + width / 4 });
      return true;
    case '-':
      plotter.zoom({ from: middle - width, to: middle + width });
      return true;
    case 'Home':
      plotter.zoom(null);
      return true;
    default:
      return false;
  }
}

/** Turning the wheel zooms around what the pointer is on. */
export function wheelPlot(plot: uPlot, plotter: Plotter, event: WheelEvent): void {
  const { from, to } = plotter.view();
  const at = plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, 'x');
  const factor = Math.exp(Math.max(-1, Math.min(1, event.deltaY / 200)));
  plotter.zoom({ from: at - (at - from) * factor, to: at + (to - at) * factor });
  event.preventDefault();
}

function rangeOf(_plot: uPlot, least: number | null, most: number | null): uPlot.Range.MinMax {
  if (least === null || most === null) return [0, 1];
  if (least === most) return [least - 1, most + 1];
  const room = (most - least) * 0.08;
  return [least - room, most + room];
}

function axisOf(colour: (name: string) => string, more: uPlot.Axis): uPlot.Axis {
  return {
    stroke: colour('--text-muted'),
    font: kFont,
    gap: 4,
    grid: { stroke: colour('--border-subtle'), width: 1 },
    ticks: { stroke: colour('--border-strong'), width: 1, size: 4 },
    ...more,
  };
}

function coloursOf(host: HTMLElement): (name: string) => string {
  const style = getComputedStyle(host);
  return (name) => style.getPropertyValue(name).trim();
}

function shownTick(tick: number): string {
  return `${Number(shownTime(tick))} s`;
}

function clamp(value: number, most: number): number {
  return Math.max(0, Math.min(most, value));
}
