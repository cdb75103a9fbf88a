// What is plotted and how it is seen: curves, axes, the span of time. Its samples are in plotter.ts.

import type { Json } from '../protocol/messages';
import { asPick, pickKey, pickName, type Pick } from './picks';

/** The topic samples takes so many words at a time. */
export const kCurvesMax = 32;
export const kAxes = 4;
/** Colours and dashes of curves; the look has one of each for each number. */
export const kColours = 8;
export const spans = [5, 10, 30, 60, 300, 1800] as const;

export type Source = { is: 'word'; pick: Pick } | { is: 'argument'; event: string; index: number };

export interface Curve {
  source: Source;
  axis: number;
  colour: number;
}

export interface PlotState {
  curves: Curve[];
  /** Seconds of the newest that are shown while nothing is zoomed. */
  span: number;
}

export const noPlot: PlotState = { curves: [], span: 30 };

export function sourceKey(source: Source): string {
  return source.is === 'word' ? pickKey(source.pick) : `${source.event}(${source.index})`;
}

export function sourceName(source: Source): string {
  return source.is === 'word' ? pickName(source.pick) : `${source.event}[${source.index}]`;
}

/** With a curve more, in the colour that is used least; an array brings its first elements. */
export function withCurve(plot: PlotState, source: Source, axis = 1): PlotState {
  const key = sourceKey(source);
  if (plot.curves.length >= kCurvesMax || plot.curves.some((one) => sourceKey(one.source) === key))
    return plot;
  return { ...plot, curves: [...plot.curves, { source, axis, colour: freeColour(plot.curves) }] };
}

export function withoutCurve(plot: PlotState, source: Source): PlotState {
  const key = sourceKey(source);
  return { ...plot, curves: plot.curves.filter((one) => sourceKey(one.source) !== key) };
}

export function withAxis(plot: PlotState, source: Source, axis: number): PlotState {
  const key = sourceKey(source);
  return {
    ...plot,
    curves: plot.curves.map((one) => (sourceKey(one.source) === key ? { ...one, axis } : one)),
  };
}

function freeColour(curves: readonly Curve[]): number {
  const used = new Array<number>(kColours).fill(0);
  for (const { colour } of curves) used[colour] = (used[colour] ?? 0) + 1;
  return used.indexOf(Math.min(...used));
}

/** A whole array goes into a plot as its elements, this many at most. */
export const kElementsPlotted = 8;

export function sourcesOf(pick: Pick, size: number): Source[] {
  if (pick.index !== undefined || size === 1) return [{ is: 'word', pick }];
  return Array.from({ length: Math.min(size, kElementsPlotted) }, (_, index) => ({
    is: 'word',
    pick: { ...pick, index },
  }));
}

export function readPlot(json: Json | undefined): PlotState {
  if (typeof json !== 'object' || json === null || Array.isArray(json)) return noPlot;
  const list = Array.isArray(json['curves']) ? json['curves'] : [];
  const span = spans.find((one) => one === json['span']) ?? noPlot.span;
  return list.slice(0, kCurvesMax).reduce<PlotState>(
    (plot, one) => {
      const curve = readCurve(one);
      if (!curve) return plot;
      const next = withCurve(plot, curve.source, curve.axis);
      return next;
    },
    { curves: [], span },
  );
}

function readCurve(json: Json): { source: Source; axis: number } | null {
  if (typeof json !== 'object' || json === null || Array.isArray(json)) return null;
  const { axis, event, index } = json;
  const on = typeof axis === 'number' && axis >= 1 && axis <= kAxes ? Math.round(axis) : 1;
  if (typeof event === 'string' && typeof index === 'number' && index >= 0)
    return { source: { is: 'argument', event, index }, axis: on };
  const pick = asPick(json['pick']);
  return pick ? { source: { is: 'word', pick }, axis: on } : null;
}

export function plotJson({ curves, span }: PlotState): Json {
  return {
    span,
    curves: curves.map(({ source, axis }): Json =>
      source.is === 'word'
        ? { pick: { ...source.pick }, axis }
        : { event: source.event, index: source.index, axis },
    ),
  };
}
