// What the run controls offer. For a simulator its clock alone says whether it runs: nodes run in a world that
// is paused, too. On a bus it is what nodes with scripts of ours, and the plan, do.

import type { Node, Topics } from '../protocol/messages';

export type RunState = 'none' | 'running' | 'held';

export function runStateOf(
  robot: Topics['robot']['is'] | undefined,
  clock: Pick<Topics['clock']['is'], 'state'> | undefined,
  plan: Topics['plan']['is'] | undefined,
): RunState {
  if (robot?.kind !== 'bus')
    return clock?.state === 'paused' ? 'held' : clock?.state === 'running' ? 'running' : 'none';
  const own = robot.nodes.filter((node) => node.doc !== undefined);
  if (plan?.state === 'paused' || own.some((node) => node.state === 'paused')) return 'held';
  const runs = plan?.state === 'running' || own.some((node) => node.state === 'running');
  return runs ? 'running' : 'none';
}

/** The line where a node is paused: asked to, at a breakpoint, or because of a fault. */
export function pausedLineOf(node: Node | undefined): number | undefined {
  const paused =
    node?.state === 'paused' || (node?.state === 'stopped' && node.fault !== undefined);
  return paused && node.program !== 'older' ? node.at?.line : undefined;
}
