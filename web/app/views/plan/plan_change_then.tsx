import { IconArrowsExchange } from '@tabler/icons-react';
import { useEffect, useState } from 'react';
import type { Doc, PlanDifference, PlanLevel } from '../../../protocol/messages';
import { kPastStep } from '../../../core/past';
import { keptOf, startValues, type StartValue } from '../../../core/plan/change_then';
import { valueOf } from '../../../core/plan_view';
import { useChanges, useStudio } from '../../hooks';
import { usePastTime } from '../../past_hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { RunFromHere } from '../run_from_here';
import { ShowDifferences } from './compare/show_differences';
import { planWords } from './live_words';

const words = planWords.change;

/** What a change means for a run from the instant that is looked back at: what counts, what keeps its values, and how it counts, too. */
export function PlanChangeThen({ doc, version }: { doc: Doc; version: number | undefined }) {
  const studio = useStudio();
  const differences = useDifferences(doc, version);
  useChanges(studio.past.changed);
  useChanges(studio.past.settings.changed);
  const levels = studio.past.plan?.levels.filter((one) => one.doc === doc) ?? [];
  // Those notices have the button.
  const isSet = studio.past.settings.of(levels).length > 0;
  return (
    <div className="notice planchange" role="status">
      <IconArrowsExchange className="icon" size={14} stroke={kStroke} aria-hidden />
      <div className="grow">
        {words.then}
        {levels.map((level) => (
          <Kept key={level.path} level={level} differences={differences} />
        ))}
      </div>
      <ShowDifferences doc={doc} from="running" />
      {isSet ? null : <RunFromHere />}
    </div>
  );
}

/** What a run from here does not take on of itself. */
function Kept({
  level,
  differences,
}: {
  level: PlanLevel;
  differences: readonly PlanDifference[];
}) {
  const studio = useStudio();
  const { past, registry } = studio;
  const at = usePastTime();
  const kept = keptOf(level, differences);
  const starts = startValues(level, differences).filter(
    ({ name }) => past.settings.get(level.path, name) === undefined,
  );
  const runFromStart = () => {
    const doc = past.plan?.doc;
    if (level.since === 0) return studio.order('plan.start', doc === undefined ? {} : { doc });
    // Somewhat before: what was on its way at that instant is heard before the change is.
    past.look(level.since - kPastStep);
    registry.run('past.continue');
  };
  return (
    <>
      {kept && at !== null && level.since < at ? (
        <p className="planchange__kept">
          {words.kept(level.actor, level.since.toFixed(1))}
          <Button small onClick={runFromStart}>
            {words.fromStart(level.since.toFixed(1))}
          </Button>
        </p>
      ) : null}
      {starts.map((one) => (
        <Start key={one.name} level={level} start={one} />
      ))}
    </>
  );
}

function Start({ level, start }: { level: PlanLevel; start: StartValue }) {
  const { past } = useStudio();
  const { name, then, to } = start;
  return (
    <p className="planchange__kept">
      {words.holds(name, valueOf(then))}
      <Button small onClick={() => past.settings.set(level.path, name, to)}>
        {words.setThen(valueOf(to))}
      </Button>
    </p>
  );
}

/** Between the document and the plan that ran; asked again with each version of the text. */
function useDifferences(doc: Doc, version: number | undefined): readonly PlanDifference[] {
  const studio = useStudio();
  const [found, setFound] = useState<readonly PlanDifference[]>([]);
  useEffect(() => {
    let counts = true;
    studio
      .send('plan.differences', { doc, against: 'running' })
      .then(({ differences }) => counts && setFound(differences))
      // Of a text with errors there are none to tell; the errors are shown.
      .catch(() => counts && setFound([]));
    return () => {
      counts = false;
    };
  }, [studio, doc, version]);
  return found;
}
