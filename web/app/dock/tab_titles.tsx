import { IconAlertOctagon, IconCpu } from '@tabler/icons-react';
import { Suspense, useEffect } from 'react';
import type { Doc } from '../../protocol/messages';
import { countsOf } from '../../core/findings';
import { partOf } from '../../core/paths';
import { usePart, useStudio, useTopic, useUnsent } from '../hooks';
import { FileIcon, kStroke } from '../parts/icons';
import { PastBadge } from '../parts/past_badge';
import { Marks, marksOf, SavedMark } from '../parts/marks';
import { text } from '../text';
import { fileKindOf, kindOf, nameOf, secondNameOf } from '../documents';
import { panelOf } from './panels';

/** The tab of a document: what it is, whether it has errors, and its marks. */
export function DocumentTitle({ doc }: { doc: Doc }) {
  const studio = useStudio();
  const scripts = useTopic('scripts', {});
  const robot = useTopic('robot', {});
  const errors = usePart('findings', {}, (is) => countsOf(is?.findings ?? [], doc).errors);
  const part = scripts?.parts.find((one) => one.doc === doc);
  const node = robot?.nodes.find((one) => one.doc === doc);
  const second = secondNameOf(studio, doc);
  const { file } = partOf(doc);
  const isUnsent = useUnsent(doc);
  const isUnsaved = usePart(
    'files',
    {},
    (is) => is?.files.find((one) => one.path === file)?.unsaved ?? false,
  );
  const unsaved = isUnsaved || isUnsent;
  const moved = usePart('doc', { doc }, (is) => is?.moved);
  useEffect(() => {
    if (moved !== undefined) studio.documents.renamed(doc, moved);
  }, [studio, doc, moved]);
  const icon = part ? (
    <IconCpu className="icon" size={14} stroke={kStroke} aria-hidden />
  ) : (
    <FileIcon kind={fileKindOf(doc)} />
  );
  return (
    <span className="doctitle">
      {icon}
      <span>{nameOf(studio, doc)}</span>{' '}
      {second ? <span className="muted num">{second}</span> : null}
      {kindOf(doc) === 'plan' ? <PastBadge /> : null}
      {errors > 0 ? (
        <IconAlertOctagon
          className="icon is-error"
          size={14}
          stroke={kStroke}
          role="img"
          aria-label={text.status.errors(errors)}
        />
      ) : null}
      {part ? (
        <Marks {...marksOf(unsaved, node)} />
      ) : kindOf(doc) === 'plan' ? (
        <PlanMarks doc={doc} saved={!unsaved} />
      ) : (
        <SavedMark saved={!unsaved} />
      )}
    </span>
  );
}

function PlanMarks({ doc, saved }: { doc: Doc; saved: boolean }) {
  const plan = useTopic('plan', {});
  const goes = plan?.state === 'running' || plan?.state === 'paused';
  const loaded = goes && (plan.doc === doc || plan.levels.some((level) => level.doc === doc));
  const runs = !loaded ? 'none' : plan.state === 'paused' ? 'held' : 'runs';
  // What was saved and could not take over: the one before runs on.
  const older = plan?.change?.state === 'refused' && plan.change.docs.includes(doc);
  const is = !loaded ? 'none' : older ? 'older' : 'current';
  return <Marks saved={saved} loaded={is} runs={runs} />;
}

export function PanelTitle({ id }: { id: string }) {
  const of = id === 'problems' ? {} : null;
  const errors = usePart('findings', of, (is) => countsOf(is?.findings ?? []).errors);
  const warnings = usePart('findings', of, (is) => countsOf(is?.findings ?? []).warnings);
  const panel = panelOf(id);
  const Subtitle = panel?.subtitle;
  return (
    <span className="paneltitle">
      {panel?.title ?? id}
      {panel?.past ? <PastBadge /> : null}
      {Subtitle ? (
        <Suspense fallback={null}>
          <Subtitle />
        </Suspense>
      ) : null}
      {errors + warnings > 0 ? (
        <span
          className={errors > 0 ? 'count is-error' : 'count is-warning'}
          data-count={errors + warnings}
        />
      ) : null}
    </span>
  );
}
