// What of a running plan its drawing shows: who works, who watches, which arrow was just taken.

import type { PlanLevel, Topics } from '../../protocol/messages';
import { supervisorKey, type Drawing } from './arrows';
import { supervisorsOf, type PlanModel } from './model';

export interface LivePlan {
  state: Topics['plan']['is']['state'];
  t: number;
  /** The active actor; '' if none. */
  actor: string;
  since: number;
  activation: number;
  watching: ReadonlySet<string>;
  values: ReadonlyMap<string, string>;
  /** The arrow that led to the active actor; null: nobody saw it. */
  taken: string | null;
}

export const noPlan: LivePlan = {
  state: 'none',
  t: 0,
  actor: '',
  since: 0,
  activation: 0,
  watching: new Set(),
  values: new Map(),
  taken: null,
};

export function livePlan(
  before: LivePlan,
  plan: Topics['plan']['is'],
  level: PlanLevel,
  model: PlanModel,
  drawing: Drawing,
): LivePlan {
  const goes = plan.state === 'running' || plan.state === 'paused';
  const watches = new Map(level.supervisors.map((one) => [one.name, one.watching]));
  const watching = supervisorsOf(model).filter(
    ({ name, owner }) =>
      watches.get(name) === true && (owner === '@start' || owner === level.actor),
  );
  const isNext = level.activation !== before.activation;
  const told = plan.story.slice(-kToldMax).map((line) => line.text);
  return {
    state: plan.state,
    t: plan.t,
    actor: goes ? level.actor : '',
    since: level.since,
    activation: level.activation,
    watching: new Set(goes ? watching.map(supervisorKey) : []),
    values: new Map(level.variables.map(({ name, value }) => [name, shown(value)])),
    taken: isNext ? takenArrow(before.actor, level.actor, drawing, told) : before.taken,
  };
}

/** Of what happened, so many lines back the reason of the last step is looked for. */
const kToldMax = 6;

/** From the actor before, one of its supervisors, or a global one; the latest that was told. */
function takenArrow(
  from: string,
  to: string,
  drawing: Drawing,
  told: readonly string[],
): string | null {
  const leads = drawing.arrows.filter(
    ({ source, target }) =>
      target === to &&
      (from === ''
        ? source === '@start'
        : source === from || source.startsWith(`${from}/`) || source.startsWith('@start/')),
  );
  if (from === '') return leads[0]?.id ?? null;
  for (const text of [...told].reverse()) {
    const meant = leads.find(({ outcome }) => text.includes(outcome));
    if (meant) return meant.id;
  }
  return leads.length === 1 ? (leads[0]?.id ?? null) : null;
}

function shown(value: PlanLevel['variables'][number]['value']): string {
  if (typeof value === 'number') return String(Number(value.toFixed(3)));
  return typeof value === 'string' ? value : JSON.stringify(value);
}
