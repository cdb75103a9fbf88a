// What of a running plan its drawing shows: who works, who watches, which arrow was just taken, how
// often each element had its turn.

import type { PlanLevel, Topics } from '../../protocol/messages';
import { arrowId, supervisorKey } from './arrows';
import { kStart, supervisorsOf, type PlanModel } from './model';

export interface Turns {
  times: number;
  /** All in all, without the activation that runs. */
  seconds: number;
}

export interface LivePlan {
  state: Topics['plan']['is']['state'];
  t: number;
  /** The active actor; '' if none. */
  actor: string;
  since: number;
  activation: number;
  watching: ReadonlySet<string>;
  values: ReadonlyMap<string, string>;
  /** What the formulas of the active actor gave, by input. */
  inputs: ReadonlyMap<string, string>;
  /** The arrow that was taken last; null: none yet. */
  taken: string | null;
  /** Counts arrows, for one that is taken again. */
  takenNumber: number;
  /** By key of an element. */
  turns: ReadonlyMap<string, Turns>;
  /** Numbers of the breakpoints that hold it. */
  pausedLineOf: readonly number[];
}

export const noPlan: LivePlan = {
  state: 'none',
  t: 0,
  actor: '',
  since: 0,
  activation: 0,
  watching: new Set(),
  values: new Map(),
  inputs: new Map(),
  taken: null,
  takenNumber: 0,
  turns: new Map(),
  pausedLineOf: [],
};

export function livePlan(plan: Topics['plan']['is'], level: PlanLevel, model: PlanModel): LivePlan {
  const goes = plan.state === 'running' || plan.state === 'paused';
  const watches = new Map(level.supervisors.map((one) => [one.name, one.watching]));
  const watching = supervisorsOf(model).filter(
    ({ name, owner }) => watches.get(name) === true && (owner === kStart || owner === level.actor),
  );
  return {
    state: plan.state,
    t: plan.t,
    actor: goes ? level.actor : '',
    since: level.since,
    activation: level.activation,
    watching: new Set(goes ? watching.map(supervisorKey) : []),
    values: new Map(level.variables.map(({ name, value }) => [name, shownValue(value)])),
    inputs: inputsOf(level),
    taken: takenArrow(level, model),
    takenNumber: level.taken?.number ?? 0,
    turns: turnsOf(level, model),
    pausedLineOf: plan.stands_at ?? [],
  };
}

function inputsOf({ inputs }: PlanLevel): Map<string, string> {
  if (typeof inputs !== 'object' || inputs === null || Array.isArray(inputs)) return new Map();
  return new Map(Object.entries(inputs).map(([name, value]) => [name, shownValue(value)]));
}

/** Supervisors are told by their name, which is one of its kind in a plan. */
function keyOfSupervisor(model: PlanModel, name: string): string | undefined {
  const found = supervisorsOf(model).find((one) => one.name === name);
  return found && supervisorKey(found);
}

function takenArrow({ taken }: PlanLevel, model: PlanModel): string | null {
  if (!taken) return null;
  switch (taken.is) {
    case 'start':
      return arrowId(kStart, '');
    case 'state':
      return arrowId(taken.element, taken.outcome);
    case 'event': {
      const key = keyOfSupervisor(model, taken.element);
      return key === undefined ? null : arrowId(key, taken.outcome);
    }
  }
}

function turnsOf({ counts }: PlanLevel, model: PlanModel): Map<string, Turns> {
  return new Map(
    counts.flatMap(({ is, name, times, seconds }): [string, Turns][] => {
      const key = is === 'actor' ? name : keyOfSupervisor(model, name);
      return key === undefined ? [] : [[key, { times, seconds }]];
    }),
  );
}

export function shownValue(value: PlanLevel['variables'][number]['value']): string {
  if (typeof value === 'number') return String(Number(value.toFixed(3)));
  return typeof value === 'string' ? value : JSON.stringify(value);
}
