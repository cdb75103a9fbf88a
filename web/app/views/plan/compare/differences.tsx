import { Suspense } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import { DifferencesLayer } from './late_parts';
import { useComparing } from './use_comparing';

/** In the drawing. Nothing is loaded for it until plans are compared. */
export function Differences({ board }: { board: PlanBoard }) {
  if (!useComparing(board.doc)) return null;
  return (
    <Suspense fallback={null}>
      <DifferencesLayer board={board} />
    </Suspense>
  );
}
