import type { Doc, PlanLevel } from '../../../protocol/messages';
import { inputsAhead, namedIn } from '../../../core/plan/ahead';
import { valueOf } from '../../../core/plan_view';
import { useChanges, useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { RunFromHere } from '../run_from_here';
import { planWords } from './live_words';
import { usePlanDesk } from './plan_desk';
import { PlanNotice } from './plan_notice';
import { RunFromStart } from './run_from_start';

const words = planWords.change;

/** Values that variables of this plan get in a run from the instant that is looked back at. */
export function PlanSettings({ doc }: { doc: Doc }) {
  const { past } = useStudio();
  useChanges(past.changed);
  useChanges(past.settings.changed);
  const levels = past.plan?.levels.filter((one) => one.doc === doc) ?? [];
  const set = levels.flatMap(({ path, variables }) =>
    variables.flatMap(({ name, value }) => {
      const to = past.settings.get(path, name);
      return to === undefined ? [] : [{ path, name, value, to }];
    }),
  );
  if (set.length === 0) return null;
  return (
    <PlanNotice end={<RunFromHere />}>
      {set.map(({ path, name, value, to }) => (
        <p key={`${path} ${name}`} className="planchange__kept">
          {words.sets(name, valueOf(to), valueOf(value))}
          <Button small kind="plain" onClick={() => past.settings.set(path, name, undefined)}>
            {words.asThen(valueOf(value))}
          </Button>
        </p>
      ))}
      {levels.map((level) => (
        <Taken key={level.path} level={level} />
      ))}
    </PlanNotice>
  );
}

/** The active actor has read the variable already: another value counts when it starts again. */
function Taken({ level }: { level: PlanLevel }) {
  const studio = useStudio();
  const { shown } = usePlanDesk(studio);
  const model = shown?.board.doc === level.doc ? shown.board.model : undefined;
  const actor = model?.actors.find((one) => one.name === level.actor);
  const taken = level.variables
    .map(({ name }) => name)
    .filter((name) => studio.past.settings.get(level.path, name) !== undefined)
    .filter((name) => namedIn(inputsAhead(actor)).has(name));
  if (taken.length === 0) return null;
  const what = words.taken(level.actor, taken.join(', '), level.since.toFixed(1));
  return <RunFromStart level={level} what={what} />;
}
