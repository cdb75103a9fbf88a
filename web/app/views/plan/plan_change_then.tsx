import { useEffect, useState } from 'react';
import type { Doc, PlanDifference, PlanLevel } from '../../../protocol/messages';
import { kAskEveryMs } from '../../../core/plan/change';
import { keptOf, startValues, type StartValue } from '../../../core/plan/change_then';
import { isPlace } from '../../../core/plan/differences';
import { valueOf } from '../../../core/plan_view';
import { useChanges, usePart, useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { RunFromHere } from '../run_from_here';
import { ShowDifferences } from './compare/show_differences';
import { planWords } from './live_words';
import { PlanNotice } from './plan_notice';
import { RunFromStart } from './run_from_start';

const words = planWords.change;

/** What a change means for a run from the instant that is looked back at: what counts, what keeps its values, and how it counts, too. */
export function PlanChangeThen({ doc }: { doc: Doc }) {
  const { past, registry } = useStudio();
  useChanges(past.changed);
  useChanges(past.settings.changed);
  const levels = past.plan?.levels.filter((one) => one.doc === doc) ?? [];
  const goesOn = levels.length > 0 && registry.isEnabled('past.continue');
  const differences = useDifferences(doc, goesOn ? past.shown : null);
  if (!goesOn || differences.length === 0) return null;
  // Those notices have the button.
  const isSet = past.settings.of(levels).length > 0;
  return (
    <PlanNotice
      end={
        <>
          <ShowDifferences doc={doc} from="then" />
          {isSet ? null : <RunFromHere />}
        </>
      }
    >
      {words.then}
      {levels.map((level) => (
        <Kept key={level.path} level={level} differences={differences} />
      ))}
    </PlanNotice>
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
  const { past } = useStudio();
  const starts = startValues(level, differences).filter(
    ({ name }) => past.settings.get(level.path, name) === undefined,
  );
  return (
    <>
      {keptOf(level, differences) ? (
        <RunFromStart level={level} what={words.kept(level.actor, level.since.toFixed(1))} />
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

const kNone: readonly PlanDifference[] = [];

/** Between the document and the plan that ran at that instant; null: not asked. */
function useDifferences(doc: Doc, t: number | null): readonly PlanDifference[] {
  const studio = useStudio();
  const version = usePart('doc', t === null ? null : { doc }, (is) => is?.version);
  const [found, setFound] = useState(kNone);
  useEffect(() => {
    if (t === null) return;
    let counts = true;
    const ask = () =>
      void studio
        .send('plan.differences', { doc, against: 'then', t })
        .then(({ differences }) => counts && setFound(differences.filter((one) => !isPlace(one))))
        // A text with errors, whose errors are shown, or a plan that is not known any more.
        .catch(() => counts && setFound(kNone));
    // Not for each instant that a drag goes through.
    const cancel = studio.world.later(kAskEveryMs, ask);
    return () => {
      counts = false;
      cancel();
    };
  }, [studio, doc, t, version]);
  return t === null ? kNone : found;
}
