import { late } from '../parts/late';
import type { Doc } from '../../protocol/messages';
import { partOf } from '../../core/paths';
import { kindOf } from '../documents';

const PlanDocument = late(() => import('./plan/plan_document'));
const WorldDocument = late(() => import('./world/world_document'));
const ScriptView = late(() => import('./script/script_view'));

/** The view of a document by its kind. */
export function DocumentView({ doc }: { doc: Doc }) {
  const kind = kindOf(doc);
  if (kind === 'world') return <WorldDocument key={doc} doc={doc} />;
  if (kind === 'plan') return <PlanDocument key={doc} doc={doc} />;
  return <ScriptView doc={doc} isScript={partOf(doc).part > 0} />;
}
