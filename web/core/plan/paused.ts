// The place at which a plan is paused: what the page brings to the front.

import type { Doc, PlanLevel, Topics } from '../../protocol/messages';

export interface PausedPlace {
  doc: Doc;
  /** '': between two actors. */
  actor: string;
  /** The plan whose actor this plan is. */
  caller: Doc | null;
}

/** The innermost level with an active actor, else the innermost one. */
export function innermost(levels: readonly PlanLevel[]): number {
  const active = levels.findLastIndex((level) => level.actor !== '');
  return active >= 0 ? active : levels.length - 1;
}

/** null: the plan is not paused. */
export function pausedPlace(plan: Topics['plan']['is'] | undefined): PausedPlace | null {
  if (plan?.state !== 'paused') return null;
  const at = innermost(plan.levels);
  const level = plan.levels[at];
  if (!level) return null;
  return { doc: level.doc, actor: level.actor, caller: plan.levels[at - 1]?.doc ?? null };
}

/** Another text for each step at which the plan is paused; '': it is not. */
export function pausedStep(plan: Topics['plan']['is'] | undefined): string {
  const place = pausedPlace(plan);
  const level = place === null ? undefined : plan?.levels[innermost(plan.levels)];
  return level ? `${level.path} ${level.activation} ${level.actor} ${level.doc}` : '';
}
