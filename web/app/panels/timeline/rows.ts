// The rows of a timeline: what is in which, how high it is, what it is called.

import type { Lanes } from '../../../core/timeline';
import { words } from './words';

export type HistoryLane = Lanes['lanes'][number];
export type HistoryCurve = Lanes['curves'][number];

interface Place {
  key: string;
  group: string;
  label: string;
  note: string;
  height: number;
}
export interface LaneRow extends Place {
  is: 'actors' | 'supervisor' | 'events';
  lane: HistoryLane;
}
export interface CurveRow extends Place {
  is: 'curve' | 'load';
  curve: HistoryCurve;
}
export type Row = LaneRow | CurveRow;

/** What is known of the words that are drawn. */
export interface CurveName {
  node: number;
  address: number;
  name: string;
  note: string;
}

const kHeights = { actors: 28, supervisor: 18, events: 20, curve: 52, load: 24 } as const;
const kGroups = { actors: words.actors, supervisor: words.supervisors, events: words.events };

export function rowsOf(
  lanes: Lanes,
  curves: readonly CurveName[],
  nodeName: (node: number) => string,
): Row[] {
  return [
    ...lanes.lanes
      .filter(({ kind, bars, marks }) => kind === 'actors' || bars.length + marks.length > 0)
      .map(rowOfLane),
    ...lanes.curves.map((curve) => rowOfCurve(curve, curves)),
    ...lanes.loads.map((curve): Row => ({
      is: 'load',
      key: `load ${curve.node}`,
      group: words.loads,
      label: nodeName(curve.node),
      note: '%',
      height: kHeights.load,
      curve,
    })),
  ];
}

function rowOfLane(lane: HistoryLane): Row {
  const { kind, path, name } = lane;
  // Of the outermost plan the group says it; a sub-plan has a name.
  const inner = path.includes('/') ? (path.split('/').at(-1) ?? '') : '';
  return {
    is: kind,
    key: `${kind} ${path} ${name}`,
    group: kGroups[kind],
    label: kind === 'actors' ? inner : name,
    note: '',
    height: kHeights[kind],
    lane,
  };
}

function rowOfCurve(curve: HistoryCurve, curves: readonly CurveName[]): Row {
  const known = curves.find(
    ({ node, address }) => node === curve.node && address === curve.address,
  );
  return {
    is: 'curve',
    key: `curve ${curve.node} ${curve.address}`,
    group: words.curves,
    label: known?.name ?? '',
    note: known?.note ?? '',
    height: kHeights.curve,
    curve,
  };
}

/** Instants that the pointer means when it is near them: edges of bars, marks. */
export function snapsOf(rows: readonly Row[]): number[] {
  return rows.flatMap((row) => {
    if ('curve' in row) return [];
    const edges =
      row.is === 'events'
        ? []
        : row.lane.bars.flatMap(({ from, to }) => (to === undefined ? [from] : [from, to]));
    return [...edges, ...row.lane.marks.map(({ t }) => t)];
  });
}

export function snapped(t: number, snaps: readonly number[], within: number): number {
  let best = t;
  let least = within;
  for (const one of snaps) {
    const distance = Math.abs(one - t);
    if (distance >= least) continue;
    least = distance;
    best = one;
  }
  return best;
}
