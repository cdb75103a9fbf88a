import { Suspense } from 'react';
import { late } from '../../parts/late';
import type { Doc } from '../../../protocol/messages';
import { PlanLive } from './plan_live';
import '../../look/plan.css';

const ScriptView = late(() => import('../script/script_view'));

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
