import { Suspense } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import type { Doc } from '../../../../protocol/messages';
import { CoverageSwitch } from '../../tests/coverage_switch';
import { CoverageLayer, CoverageStrip } from './late_parts';
import { useIsCounted, useShowsCoverage } from './use_coverage';

/** Among the switches of the drawing, once tests have gone through the plan. */
export function CoverageOfTests({ doc }: { doc: Doc }) {
  return useIsCounted(doc) ? <CoverageSwitch /> : null;
}

/** Above the drawing. */
export function CoverageSummary({ doc }: { doc: Doc }) {
  if (!useShowsCoverage(doc)) return null;
  return (
    <Suspense fallback={null}>
      <CoverageStrip doc={doc} />
    </Suspense>
  );
}

/** In the drawing. */
export function Coverage({ board }: { board: PlanBoard }) {
  if (!useShowsCoverage(board.doc)) return null;
  return (
    <Suspense fallback={null}>
      <CoverageLayer board={board} />
    </Suspense>
  );
}
