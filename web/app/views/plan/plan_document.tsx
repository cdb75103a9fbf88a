import { Suspense, useEffect, useEffectEvent } from 'react';
import { late } from '../../parts/late';
import type { Doc, Place } from '../../../protocol/messages';
import { useStudio, useTopic, useWindow } from '../../hooks';
import { FindingNotice } from '../finding_notice';
import { DiskNotice } from '../script/script_notices';
import { DifferencesStrip } from './compare/late_parts';
import { ShowDifferences } from './compare/show_differences';
import { useComparing } from './compare/use_comparing';
import { CoverageSummary } from './coverage/coverage';
import { PlanChange } from './plan_change';
import { planDeskOf } from './plan_desk';
import { PlanLive } from './plan_live';
import { PlanSettings } from './plan_settings';
import { togglePlanOption, usePlanOptions } from './plan_options';
import { PlanTools } from './plan_tools';
import { TryBar } from './try/late_bar';
import { useTrying } from './try/use_trying';
import '../../look/plan.css';

const ScriptView = late(() => import('../script/script_view'));
const PlanCode = late(() => import('./code/plan_code'));
const PlanCanvas = late(() => import('./canvas/plan_canvas'));

/** A plan drawn; beside it, if wanted, its text, and what it does while it runs. */
export default function PlanDocument({ doc }: { doc: Doc }) {
  const options = usePlanOptions();
  useRevealed(doc);
  return (
    <div className="plan">
      <div className="plan__main">
        <PlanTools doc={doc} />
        <DiskNotice doc={doc} more={<ShowDifferences doc={doc} from="disk" />} />
        <PlanSettings doc={doc} />
        <PlanChange doc={doc} />
        <Differences doc={doc} />
        <Tried doc={doc} />
        <CoverageSummary doc={doc} />
        {options.text ? null : <Found doc={doc} />}
        <Suspense fallback={null}>
          <PlanCanvas doc={doc} />
        </Suspense>
      </div>
      {options.text ? (
        <div className="plan__text">
          <Suspense fallback={null}>
            <ScriptView doc={doc} isScript={false} />
          </Suspense>
        </div>
      ) : null}
      {options.code ? (
        <div className="plan__text">
          <Suspense fallback={null}>
            <PlanCode doc={doc} />
          </Suspense>
        </div>
      ) : null}
      {options.live ? <PlanLive doc={doc} /> : null}
    </div>
  );
}

/** Nothing is loaded for it until plans are compared. */
function Differences({ doc }: { doc: Doc }) {
  if (!useComparing(doc)) return null;
  return (
    <Suspense fallback={null}>
      <DifferencesStrip doc={doc} />
    </Suspense>
  );
}

/** Nor for a try. */
function Tried({ doc }: { doc: Doc }) {
  if (!useTrying(doc)) return null;
  return (
    <Suspense fallback={null}>
      <TryBar doc={doc} />
    </Suspense>
  );
}

function Found({ doc }: { doc: Doc }) {
  const studio = useStudio();
  return (
    <FindingNotice
      doc={doc}
      onShow={({ element }) => selectOnBoard(planDeskOf(studio), doc, element)}
    />
  );
}

function selectOnBoard(
  desk: ReturnType<typeof planDeskOf>,
  doc: Doc,
  element: string | undefined,
): boolean {
  const { shown } = desk;
  const key = element && shown?.board.doc === doc ? shown.board.keyOf(element) : null;
  if (!shown || !key) return false;
  shown.board.select(key);
  shown.focus(key);
  return true;
}

/** A place in the text is asked for: the element that is meant is chosen, else the text is shown. */
function useRevealed(doc: Doc): void {
  const studio = useStudio();
  const reveal = useWindow((window) => window.reveal);
  const findings = useTopic('findings', {})?.findings;
  // Findings that come later are no reason to show this one again.
  const show = useEffectEvent(({ line, column }: Place) => {
    const meant = findings?.find(
      (one) => one.doc === doc && one.at.line === line && one.at.column === column,
    );
    if (!selectOnBoard(planDeskOf(studio), doc, meant?.element))
      togglePlanOption(studio, 'text', true);
  });
  useEffect(() => {
    if (reveal?.what === 'doc' && reveal.doc === doc && reveal.at) show(reveal.at);
  }, [doc, reveal]);
}
