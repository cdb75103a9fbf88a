// What a person does with breakpoints of a plan, wherever they are shown.

import type { PlanBreakpoint } from '../../../protocol/messages';
import { isAt, placeOf, renamed, type BreakPlace, type Renamed } from '../../../core/plan/breaks';
import type { PlanBoard } from '../../../core/plan/board';
import type { Studio } from '../../../core/studio';

export function breakAt(
  studio: Studio,
  doc: string,
  place: BreakPlace,
): PlanBreakpoint | undefined {
  const all = studio.topics.get('breakpoints', {})?.plans ?? [];
  return all.find((one) => one.doc === doc && isAt(one, place));
}

/** Sets one at an element or arrow, or deletes it. */
export function toggleBreak(studio: Studio, board: PlanBoard, key: string): void {
  const place = placeOf(board.model, key);
  if (!place) return;
  const there = breakAt(studio, board.doc, place);
  if (there) studio.order('plan.break.clear', { number: there.number });
  else studio.order('plan.break.set', { doc: board.doc, ...place });
}

/** Does what may give an element another name; its breakpoints follow it. False: it was refused. */
export function withBreaks(studio: Studio, board: PlanBoard, act: () => boolean | void): boolean {
  const before = board.model;
  if (act() === false) return false;
  const change = renamed(before, board.model);
  if (change) renameBreaks(studio, board.doc, change);
  return true;
}

function renameBreaks(studio: Studio, doc: string, { is, from, to }: Renamed): void {
  for (const one of studio.topics.get('breakpoints', {})?.plans ?? []) {
    const isOfIts = (one.kind === 'event') === (is === 'supervisor') && one.kind !== 'condition';
    if (one.doc === doc && one.element === from && isOfIts)
      changeBreak(studio, { ...one, element: to }, {});
  }
}

type Change = Partial<Pick<PlanBreakpoint, 'condition' | 'stop_at' | 'enabled'>>;

/** What is not told stays as it is. */
export function changeBreak(studio: Studio, one: PlanBreakpoint, to: Change): void {
  studio.order('plan.break.set', changed(one, to));
}

/** The same; it fails with the sentence of the server. */
export async function setBreak(studio: Studio, one: PlanBreakpoint, to: Change): Promise<void> {
  await studio.send('plan.break.set', changed(one, to));
}

function changed(one: PlanBreakpoint, to: Change) {
  const { number, doc, kind, element, outcome, condition, stop_at, enabled } = one;
  return { number, doc, kind, element, outcome, condition, stop_at, enabled, ...to };
}
