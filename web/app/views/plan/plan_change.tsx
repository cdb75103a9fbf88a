import { useEffect, useRef, useState, type ReactNode } from 'react';
import type { Doc, Topics } from '../../../protocol/messages';
import { ChangeQuestion, type ChangeAnswer } from '../../../core/plan/change';
import { partOf } from '../../../core/paths';
import { usePastTime } from '../../past_hooks';
import { useDrives, usePart, useStudio, useTopic } from '../../hooks';
import { Button } from '../../parts/button';
import { ShowDifferences } from './compare/show_differences';
import { planWords } from './live_words';
import { PlanChangeThen } from './plan_change_then';
import { PlanNotice } from './plan_notice';

const words = planWords.change;

/** What saving would do to the plan that runs, and what the last save has done. */
export function PlanChange({ doc }: { doc: Doc }) {
  const studio = useStudio();
  const drives = useDrives();
  const plan = useTopic('plan', {});
  const past = usePastTime();
  const unsaved = useUnsaved(doc);
  const goes = plan?.state === 'running' || plan?.state === 'paused';
  const answer = useAnswer(doc, goes && unsaved && past === null, plan);
  if (past !== null) return <PlanChangeThen doc={doc} />;
  if (!goes) return null;
  if (unsaved) {
    if (!answer?.runs) return null;
    const can = answer.reasons.length === 0;
    return (
      <Line
        good={can}
        what={can ? words.takes : words.cannot}
        reasons={answer.reasons}
        end={
          <>
            <ShowDifferences doc={doc} from="running" />
            <Button small disabled={!drives} onClick={() => studio.registry.run('file.save')}>
              {words.save}
            </Button>
          </>
        }
      />
    );
  }
  const last = plan.change;
  if (last?.state !== 'refused' || !last.docs.includes(doc)) return null;
  return (
    <Line
      good={false}
      what={words.refused}
      reasons={last.reasons}
      end={
        <>
          <ShowDifferences doc={doc} from="running" />
          <Button
            small
            disabled={!drives}
            onClick={() =>
              void studio
                .sendInTurn('plan.start', plan.doc === undefined ? {} : { doc: plan.doc })
                .catch((problem: unknown) => studio.tell(problem))
            }
          >
            {words.again}
          </Button>
        </>
      }
    />
  );
}

function Line(props: { good: boolean; what: string; reasons: readonly string[]; end: ReactNode }) {
  const { good, what, reasons, end } = props;
  return (
    <PlanNotice good={good} end={end}>
      {what}
      {reasons.length === 0 ? null : (
        <ul className="planchange__why">
          {reasons.map((reason, index) => (
            <li key={index}>{reason}</li>
          ))}
        </ul>
      )}
    </PlanNotice>
  );
}

function useUnsaved(doc: Doc): boolean {
  const { file } = partOf(doc);
  return usePart('files', {}, (is) => is?.files.find((one) => one.path === file)?.unsaved ?? false);
}

/** Asked again whenever the text or what is active is another one. */
function useAnswer(
  doc: Doc,
  asks: boolean,
  plan: Topics['plan']['is'] | undefined,
): ChangeAnswer | null {
  const studio = useStudio();
  const version = usePart('doc', asks ? { doc } : null, (is) => is?.version);
  const active = plan?.levels.map((level) => `${level.path} ${level.activation}`).join(' ');
  const [answer, setAnswer] = useState<ChangeAnswer | null>(null);
  const question = useRef<ChangeQuestion | null>(null);
  useEffect(() => {
    if (!asks) return;
    const made = new ChangeQuestion(
      () => studio.send('plan.check_change', { doc }),
      (ms, act) => studio.world.later(ms, act),
    );
    question.current = made;
    made.changed.on(() => setAnswer(made.answer));
    return () => {
      made.end();
      question.current = null;
      setAnswer(null);
    };
  }, [studio, doc, asks]);
  useEffect(() => question.current?.look(), [studio, doc, asks, version, active]);
  return answer;
}
