import { lazy, Suspense } from 'react';
import type { Doc } from '../../../protocol/messages';
import { PlanLive } from './plan_live';
import '../../look/plan.css';

const ScriptView = lazy(() => import('../script/script_view'));

/** A plan as text, and beside it what it does while it runs. */
export default function PlanDocument({ doc }: { doc: Doc }) {
  return (
    <div className="plan">
      <div className="plan__text">
        <Suspense fallback={null}>
          <ScriptView doc={doc} isScript={false} />
        </Suspense>
      </div>
      <PlanLive doc={doc} />
    </div>
  );
}
