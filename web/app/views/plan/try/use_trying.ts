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

/** Takes the same way again when the plan is edited. */
export function useTakenAgain(trying: Trying, doc: Doc): void {
  const version = usePart('doc', { doc }, (is) => is?.version);
  const before = useRef(version);
  useEffect(() => {
    const isNews = before.current !== undefined && before.current !== version;
    before.current = version;
    if (isNews) void trying.again();
  }, [trying, version]);
}
