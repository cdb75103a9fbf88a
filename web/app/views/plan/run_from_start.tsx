import type { PlanLevel } from '../../../protocol/messages';
import { kPastStep } from '../../../core/past';
import type { Studio } from '../../../core/studio';
import { useStudio } from '../../hooks';
import { usePastTime } from '../../past_hooks';
import { Button } from '../../parts/button';
import { planWords } from './live_words';

const words = planWords.change;

/** What the active actor took when it started, and the way to the instant at which it takes it again. */
export function RunFromStart({ level, what }: { level: PlanLevel; what: string }) {
  const studio = useStudio();
  const at = usePastTime();
  if (at === null || level.since >= at) return null;
  return (
    <p className="planchange__kept">
      {what}
      <Button small onClick={() => runFromStart(studio, level)}>
        {words.fromStart(level.since.toFixed(1))}
      </Button>
    </p>
  );
}

function runFromStart(studio: Studio, level: PlanLevel): void {
  const { past, registry } = studio;
  if (level.since > kPastStep) {
    // Somewhat before: what was on its way at that instant is heard before the change is.
    past.look(level.since - kPastStep);
    registry.run('past.continue');
    return;
  }
  const { doc, levels = [] } = past.plan ?? {};
  const outermost = past.settings.of(levels).filter((one) => one.level === 0);
  const set = Object.fromEntries(outermost.map(({ name, value }) => [name, value]));
  studio.order('plan.start', { ...(doc === undefined ? {} : { doc }), set });
}
