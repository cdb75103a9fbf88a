import { testOptionsOf } from '../../../../core/tests';
import type { Doc, PlanCoverage } from '../../../../protocol/messages';
import { useChanges, usePart, useStudio, useTopic } from '../../../hooks';

/** The last tests went through this plan. */
export function useIsCounted(doc: Doc): boolean {
  return usePart('tests', {}, (is) => is?.coverage.some(({ path }) => path === doc) ?? false);
}

/** It is to be shown. */
export function useShowsCoverage(doc: Doc): boolean {
  const options = testOptionsOf(useStudio());
  useChanges(options.changed);
  return useIsCounted(doc) && options.coverage;
}

/** What they took of it; null: nothing is known. */
export function usePlanCoverage(doc: Doc): { counts: PlanCoverage; changed: boolean } | null {
  const coverage = useTopic('coverage', { doc });
  return coverage?.plan ? { counts: coverage.plan, changed: coverage.changed } : null;
}
