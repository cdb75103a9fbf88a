import { IconArrowsExchange } from '@tabler/icons-react';
import type { Doc } from '../../../protocol/messages';
import { valueOf } from '../../../core/plan_view';
import { useChanges, useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { RunFromHere } from '../run_from_here';
import { planWords } from './live_words';

const words = planWords.change;

/** Values that variables of this plan get in a run from the instant that is looked back at. */
export function PlanSettings({ doc }: { doc: Doc }) {
  const { past } = useStudio();
  useChanges(past.changed);
  useChanges(past.settings.changed);
  const set = (past.plan?.levels ?? []).flatMap(({ path, doc: of, variables }) =>
    variables.flatMap(({ name, value }) => {
      const to = of === doc ? past.settings.get(path, name) : undefined;
      return to === undefined ? [] : [{ path, name, value, to }];
    }),
  );
  if (set.length === 0) return null;
  return (
    <div className="notice planchange" role="status">
      <IconArrowsExchange className="icon" size={14} stroke={kStroke} aria-hidden />
      <div className="grow">
        {set.map(({ path, name, value, to }) => (
          <p key={`${path} ${name}`} className="planchange__kept">
            {words.sets(name, valueOf(to), valueOf(value))}
            <Button small kind="plain" onClick={() => past.settings.set(path, name, undefined)}>
              {words.asThen(valueOf(value))}
            </Button>
          </p>
        ))}
      </div>
      <RunFromHere />
    </div>
  );
}
