// Which plan F5 is for, and what runs: one answer for the keys, the top bar and the notices.

import type { Doc, Json, Topics } from '../protocol/messages';

type Robot = Topics['robot']['is'];
type Plan = Topics['plan']['is'];

/** In .vagus/state.json, by state.put. */
export const kLastPlan = 'run.plan';

export const isPlan = (doc: Doc): boolean => doc.endsWith('.plan.json');

export interface Choice {
  /** What is looked at. */
  doc: Doc | null;
  /** What state.put kept. */
  kept: Json | undefined;
  /** The plan that vagus.json names. */
  project: Doc | undefined;
  exists(doc: Doc): boolean;
}

/** The plan that is looked at; else the one that ran last; else that of vagus.json. */
export function planMeant({ doc, kept, project, exists }: Choice): Doc | undefined {
  if (doc !== null && isPlan(doc)) return doc;
  return keptPlan(kept, exists) ?? project;
}

/** In a sub-plan that is active F5 is for the plan that runs: it is not replaced by a part of itself. */
export function planInRun(meant: Doc | undefined, plan: Plan | undefined): Doc | undefined {
  const goes = plan?.state === 'running' || plan?.state === 'paused';
  const isInside = goes && plan.levels.some((level) => level.doc === meant);
  return isInside ? (plan.doc ?? meant) : meant;
}

function keptPlan(kept: Json | undefined, exists: (doc: Doc) => boolean): Doc | undefined {
  if (typeof kept !== 'object' || kept === null || Array.isArray(kept)) return undefined;
  const last = kept[kLastPlan];
  return typeof last === 'string' && isPlan(last) && exists(last) ? last : undefined;
}

export interface Order {
  command: 'run.start' | 'plan.start';
  /** Of plan.start. */
  doc?: Doc;
}

/** What F5 sends. What is paused goes on; another plan than the one that runs is started instead of it. */
export function runOrder(
  meant: Doc | undefined,
  plan: Plan | undefined,
  held: boolean,
  project: Doc | undefined,
): Order {
  const running = plan?.state === 'running' ? plan.doc : undefined;
  const goesOn = held || plan?.state === 'paused' || (running !== undefined && running === meant);
  if (goesOn || meant === undefined) return { command: 'run.start' };
  if (running === undefined && meant === project) return { command: 'run.start' };
  return { command: 'plan.start', doc: meant };
}

/** "WallFollow"; nodes that run without a plan; '' if only a world passes its time. */
export function whatRuns(robot: Robot | undefined, plan: Plan | undefined): string {
  const goes = plan?.state === 'running' || plan?.state === 'paused';
  if (goes && plan.doc !== undefined) return planName(plan.doc);
  const own = (robot?.nodes ?? []).filter((node) => node.doc !== undefined);
  const runs = own.filter(({ state }) => state === 'running');
  return runs.map((node) => node.name).join(', ');
}

export interface EndedPlan {
  name: string;
  result: NonNullable<Plan['result']>;
}

/** The plan that ran last in the run that is there, once it has ended. */
export function endedPlan(plan: Plan | undefined): EndedPlan | null {
  if (plan?.state !== 'ended' || plan.doc === undefined || !plan.result) return null;
  return { name: planName(plan.doc), result: plan.result };
}

type RunClock = Pick<Topics['clock']['is'], 'state' | 't'>;

/** Before the first run: no time has passed. */
export function hasNotBegun(clock: RunClock | undefined): boolean {
  return clock?.state === 'none' && clock.t === 0;
}

/** In a simulator whose time has not begun to pass, nodes have their scripts and wait. */
export function isReady(
  robot: Pick<Robot, 'kind'> | undefined,
  clock: RunClock | undefined,
): boolean {
  return robot?.kind === 'simulator' && hasNotBegun(clock);
}

export function planName(doc: Doc): string {
  return doc.replace(/^.*\//, '').replace(/\.plan\.json$/, '');
}

export type Missing = 'project' | 'target' | 'node' | 'robot';

/** What a run lacks: a world or a robot (a project, where none says which), a node that answers, a robot in the world. */
export function missingFor(
  robot: Robot | undefined,
  project: { world?: Doc; bare?: boolean } | undefined,
): Missing | null {
  if (!robot) return null;
  const where = project?.bare ? 'project' : 'target';
  if (robot.kind === 'none') return project?.world === undefined ? where : null;
  if (robot.state !== 'connected' || robot.nodes.length > 0) return null;
  return robot.kind === 'bus' ? 'node' : 'robot';
}
