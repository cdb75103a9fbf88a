// Breakpoints of a plan, by what is drawn: an actor, a row (id of its arrow), a supervisor.

import type { PlanBreakpoint } from '../../protocol/messages';
import { arrowId, supervisorKey } from './arrows';
import { supervisorsOf, type PlanModel, type Supervisor } from './model';

/** What a breakpoint stops at; as the protocol has it. */
export type BreakPlace = Pick<PlanBreakpoint, 'kind' | 'element' | 'outcome'>;

export type Disc = 'on' | 'if' | 'off' | 'unset';

/** The place that the key of an element or the id of an arrow stands for; null: none can be there. */
export function placeOf(model: PlanModel, key: string | null): BreakPlace | null {
  if (key === null) return null;
  for (const actor of model.actors) {
    if (actor.name === key) return { kind: 'actor', element: key, outcome: '' };
    for (const { name } of actor.outcomes)
      if (arrowId(actor.name, name) === key)
        return { kind: 'state', element: actor.name, outcome: name };
  }
  for (const supervisor of supervisorsOf(model)) {
    const owner = supervisorKey(supervisor);
    if (owner === key) return ofSupervisor(supervisor);
    for (const { name } of supervisor.outcomes)
      if (arrowId(owner, name) === key)
        return { kind: 'event', element: supervisor.name, outcome: name };
  }
  return null;
}

/** Its only event, or any of several. */
function ofSupervisor({ name, outcomes }: Supervisor): BreakPlace {
  const only = outcomes.length === 1 ? outcomes[0] : undefined;
  return { kind: 'event', element: name, outcome: only?.name ?? '' };
}

/** Where a breakpoint is drawn; null: the plan has no such place, or it is a condition. */
export function keyOfBreak(model: PlanModel, one: BreakPlace): string | null {
  if (one.kind === 'condition') return null;
  if (one.kind === 'event') {
    const supervisor = supervisorsOf(model).find(({ name }) => name === one.element);
    if (!supervisor) return null;
    const key = supervisorKey(supervisor);
    const atTip = one.outcome === '' || supervisor.outcomes.length === 1;
    return atTip ? key : arrowId(key, one.outcome);
  }
  if (!model.actors.some(({ name }) => name === one.element)) return null;
  return one.kind === 'actor' ? one.element : arrowId(one.element, one.outcome);
}

export function isAt(one: PlanBreakpoint, place: BreakPlace): boolean {
  return one.kind === place.kind && one.element === place.element && one.outcome === place.outcome;
}

/** Filled: on; a bar: only sometimes; a ring: off; dashed: the plan that runs cannot have it. */
export function discOf(
  one: Pick<PlanBreakpoint, 'enabled' | 'condition' | 'stop_at' | 'set' | 'why' | 'kind'>,
): Disc {
  if (!one.enabled) return 'off';
  if (!one.set && one.why !== undefined) return 'unset';
  return (one.kind !== 'condition' && one.condition !== '') || one.stop_at > 1 ? 'if' : 'on';
}

export interface Renamed {
  is: 'actor' | 'supervisor';
  from: string;
  to: string;
}

/** What one change of a plan renamed; null: nothing, or more than a name came or went. */
export function renamed(before: PlanModel, after: PlanModel): Renamed | null {
  const actor = oneOther(namesOf(before.actors), namesOf(after.actors));
  const supervisor = oneOther(namesOf(supervisorsOf(before)), namesOf(supervisorsOf(after)));
  if (actor && supervisor) return null;
  if (actor) return { is: 'actor', ...actor };
  return supervisor ? { is: 'supervisor', ...supervisor } : null;
}

const namesOf = (elements: readonly { name: string }[]) =>
  new Set(elements.map(({ name }) => name));

function oneOther(
  before: ReadonlySet<string>,
  after: ReadonlySet<string>,
): { from: string; to: string } | null {
  const [from, ...moreGone] = [...before].filter((name) => !after.has(name));
  const [to, ...moreCame] = [...after].filter((name) => !before.has(name));
  const one = moreGone.length === 0 && moreCame.length === 0;
  return one && from !== undefined && to !== undefined ? { from, to } : null;
}
