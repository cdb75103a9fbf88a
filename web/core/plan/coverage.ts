// What runs took of a plan, by what its drawing shows: elements by their keys, arrows by their ids.

import type { PlanCoverage } from '../../protocol/messages';
import { arrowId, supervisorKey } from './arrows';
import { kStart, supervisorsOf, type PlanModel } from './model';

export interface Taken {
  /** Of an element, or the id of an arrow. */
  key: string;
  isArrow: boolean;
  /** How often. */
  count: number;
}

/** All that the plan has now and that was counted; what came since is not there. */
export function takenIn(model: PlanModel, counts: PlanCoverage): Taken[] {
  const taken: Taken[] = [];
  const add = (key: string, isArrow: boolean, count: number | undefined) => {
    if (count !== undefined) taken.push({ key, isArrow, count });
  };
  for (const { name, outcomes } of model.actors) {
    add(name, false, counts.actors[name]);
    for (const state of outcomes)
      add(arrowId(name, state.name), true, counts.states[`${name}: ${state.name}`]);
  }
  for (const supervisor of supervisorsOf(model)) {
    const { owner, name, outcomes } = supervisor;
    const key = supervisorKey(supervisor);
    const counted = owner === kStart ? name : `${owner}.${name}`;
    add(key, false, counts.supervisors[counted]);
    for (const event of outcomes)
      add(arrowId(key, event.name), true, counts.events[`${counted}: ${event.name}`]);
  }
  return taken;
}

export type CoverageKind = keyof PlanCoverage;
export const coverageKinds: readonly CoverageKind[] = [
  'actors',
  'states',
  'supervisors',
  'events',
  'pairs',
];

export interface Counted {
  kind: CoverageKind;
  /** As it was counted: "followWall: WallLost". */
  name: string;
  count: number;
  /** What of the drawing it is about. */
  keys: readonly string[];
}

/** Everything that was counted, as a list. */
export function countedIn(counts: PlanCoverage): Counted[] {
  return coverageKinds.flatMap((kind) =>
    Object.entries(counts[kind]).map(([name, count]) => ({
      kind,
      name,
      count,
      keys: keysOf(kind, name),
    })),
  );
}

function keysOf(kind: CoverageKind, name: string): readonly string[] {
  const [element = '', outcome = ''] = name.split(': ');
  switch (kind) {
    case 'actors':
      return [name];
    case 'states':
      return [arrowId(element, outcome)];
    case 'supervisors':
      return [keyOfSupervisor(element)];
    case 'events':
      return [arrowId(keyOfSupervisor(element), outcome)];
    case 'pairs':
      return name.split(', ');
  }
}

function keyOfSupervisor(counted: string): string {
  const dot = counted.lastIndexOf('.');
  return supervisorKey(
    dot < 0
      ? { owner: kStart, name: counted }
      : { owner: counted.slice(0, dot), name: counted.slice(dot + 1) },
  );
}
