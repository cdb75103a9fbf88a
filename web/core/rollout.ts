// A roll-out as the page of a fleet shows it: the robots in an order that says first what went wrong.

import type { RolloutRobot, Topics } from '../protocol/messages';

export type Rollout = Topics['rollout']['is'];
export interface RolloutRow extends RolloutRobot {
  readonly name: string;
}

/** So many rows are shown; how many more there are is said. */
export const kRolloutRows = 200;

const order: readonly RolloutRobot['is'][] = ['failed', 'started', 'wanted', 'later', 'well'];

/** What needs a person first; of those alike, as they get the version. */
export function rowsOf(rollout: Rollout): RolloutRow[] {
  return Object.entries(rollout.robots)
    .map(([name, robot]) => ({ name, ...robot }))
    .toSorted((a, b) => order.indexOf(a.is) - order.indexOf(b.is) || a.at - b.at);
}

export function wellIn(rows: readonly RolloutRow[]): number {
  return rows.filter(({ is }) => is === 'well').length;
}

/** Some robot has the version that was rolled out, and nothing is under way. */
export function mayRollBack(rollout: Rollout): boolean {
  return (
    !rollout.back &&
    rollout.state !== 'running' &&
    Object.values(rollout.robots).some(({ has }) => has)
  );
}
