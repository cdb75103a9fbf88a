import { useEffect, useRef } from 'react';
import type { Doc } from '../../../../protocol/messages';
import { tryingOf, type Tried, type Trying } from '../../../../core/plan/trying';
import { useChanges, usePart, useStudio } from '../../../hooks';

/** What the window tries, if it is this plan. */
export function useTrying(doc: Doc): Trying | null {
  const trying = tryingOf(useStudio());
  useChanges(trying.changed);
  return trying.doc === doc ? trying : null;
}

/** The plan as it is tried, in place of what runs; null: none is tried. */
export function useTriedPlan(): Tried['plan'] | null {
  const trying = tryingOf(useStudio());
  useChanges(trying.changed);
  return trying.answer?.plan ?? null;
}

/** Takes the same way again when the plan is edited, one of its sub-plans, or a toolbox. */
export function useTakenAgain(trying: Trying): void {
  const checked = usePart('findings', {}, (is) => is && versionsOf(is.versions));
  const before = useRef(checked);
  useEffect(() => {
    const isNews = before.current !== undefined && before.current !== checked;
    before.current = checked;
    if (isNews) void trying.again();
  }, [trying, checked]);
}

/** Texts of plans and toolboxes, as one value; scripts have no part in it. */
function versionsOf(versions: Readonly<Record<Doc, number>>): string {
  return JSON.stringify(Object.entries(versions).filter(([doc]) => !doc.includes('#')));
}
