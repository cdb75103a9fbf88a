// What a changed plan leaves as it was where it takes over in the middle of a run (docs/plans.md,
// P31): an active actor keeps what it started with, and variables keep their values.

import type { Json, PlanDifference, PlanLevel } from '../../protocol/messages';

/** Of the active actor of a level something is changed that counts from its next start on. */
export function keptOf(level: PlanLevel, differences: readonly PlanDifference[]): boolean {
  return differences.some(
    ({ path: [list, actor, ...rest] }) =>
      list === 'actors' && actor === level.actor && countsAtStart(rest),
  );
}

/** Targets count at once, also those of the actor that is active; words for people change nothing. */
function countsAtStart([part, , inside]: readonly string[]): boolean {
  if (part === 'supervisors') return inside !== 'events' && inside !== 'help';
  return part === 'in' || part === 'out' || part === 'template' || part === 'plan';
}

/** A variable whose `initial` is another one now. */
export interface StartValue {
  name: string;
  /** what it is at the instant that is looked at */
  then: Json;
  to: Json;
}

export function startValues(
  { variables }: PlanLevel,
  differences: readonly PlanDifference[],
): StartValue[] {
  return differences.flatMap(({ kind, path: [list, name, part], after }) => {
    if (kind !== 'changed' || list !== 'configuration' || part !== 'initial') return [];
    const variable = variables.find((one) => one.name === name);
    if (variable === undefined || after === undefined || after === variable.value) return [];
    return [{ name: variable.name, then: variable.value, to: after }];
  });
}
