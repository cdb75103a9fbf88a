import {
  IconPlayerPause,
  IconPlayerPlay,
  IconPlayerSkipForward,
  IconPlayerStop,
} from '@tabler/icons-react';
import type { Doc, Topics } from '../../../protocol/messages';
import { countsOf } from '../../../core/findings';
import { update } from '../../../core/window_state';
import { useStudio, useTopic } from '../../hooks';
import { useMayAct } from '../../past_hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { planWords } from './live_words';

const words = planWords;
const size = { size: 14, stroke: kStroke };

/** State of the plan, and run, pause, step, stop of it alone. */
export function PlanControls({ doc, plan }: { doc: Doc; plan: Topics['plan']['is'] | undefined }) {
  const { registry, window: store } = useStudio();
  const drives = useMayAct();
  const { errors } = countsOf(useTopic('findings', {})?.findings ?? [], doc);
  const state = plan?.state ?? 'none';
  const goes = state === 'running' || state === 'paused';
  // The commands are about the plan that is looked at: this one.
  const run = (id: string) => () => {
    update(store, (draft) => void (draft.doc = doc));
    registry.run(id);
  };
  return (
    <header className="planlive__head">
      <span className={`planstate planstate--${state}`}>{stateText(plan)}</span>
      <span className="grow" />
      {goes ? (
        <Button
          kind="plain"
          small
          className="is-stop"
          disabled={!drives}
          tip={words.stop}
          icon={<IconPlayerStop {...size} />}
          onClick={run('plan.stop')}
        />
      ) : null}
      {state === 'running' ? (
        <Button
          kind="plain"
          small
          disabled={!drives}
          tip={words.pause}
          icon={<IconPlayerPause {...size} />}
          onClick={run('plan.pause')}
        />
      ) : null}
      {state === 'paused' ? (
        <Button
          small
          disabled={!drives}
          tip={words.continue}
          aria-label={words.continue}
          icon={<IconPlayerPlay {...size} />}
          onClick={run('plan.continue')}
        >
          <span className="planlive__word">{words.continue}</span>
        </Button>
      ) : null}
      {goes ? (
        <Button
          kind="plain"
          small
          disabled={!drives}
          tip={words.step}
          icon={<IconPlayerSkipForward {...size} />}
          onClick={run('plan.step')}
        />
      ) : (
        <Button
          small
          disabled={!drives || errors > 0}
          title={errors > 0 ? words.errors : undefined}
          icon={<IconPlayerPlay {...size} />}
          onClick={run('plan.start')}
        >
          {words.start}
        </Button>
      )}
    </header>
  );
}

function stateText(plan: Topics['plan']['is'] | undefined): string {
  if (plan?.state === 'ended' && plan.result) return words.results[plan.result];
  return words.states[plan?.state ?? 'none'];
}
