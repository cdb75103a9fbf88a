// Which arrow led to the actor that is active, told by what happened alone: for an instant of the past,
// whose step before nobody has seen.

import type { PlanLevel, Topics } from '../../protocol/messages';
import type { Drawing } from './arrows';

/** "followWall: WallLost → turn", as the story of a plan says it. */
const kLed = /^(.+): (.+) → (.+)$/;

export function ledHere(
  plan: Pick<Topics['plan']['is'], 'story'>,
  level: Pick<PlanLevel, 'actor' | 'since' | 'activation'>,
  drawing: Pick<Drawing, 'arrows'>,
): string | null {
  const { actor } = level;
  if (actor === '') return null;
  const leads = drawing.arrows.filter(({ target }) => target === actor);
  for (const { t, text } of [...plan.story].reverse()) {
    const [, name = '', outcome, target] = kLed.exec(text) ?? [];
    if (target !== actor || t > level.since) continue;
    const meant = leads.find(
      (arrow) =>
        arrow.outcome === outcome && (arrow.source === name || arrow.source.endsWith(`/${name}`)),
    );
    if (meant) return meant.id;
  }
  if (level.activation > 1) return null;
  return leads.find(({ source }) => source === '@start')?.id ?? null;
}
