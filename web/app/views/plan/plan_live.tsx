import { useState } from 'react';
import type { Doc, PlanLevel } from '../../../protocol/messages';
import { shownLevel } from '../../../core/plan_view';
import { shownName } from '../../../core/paths';
import { useShownPlan } from '../../past_hooks';
import { Blank } from '../../parts/blank';
import { ActiveActor } from './active_actor';
import { PlanControls } from './plan_controls';
import { PlanStory } from './plan_story';
import { PlanVariables } from './plan_variables';
import { PlanWatchers } from './plan_watchers';
import { planWords } from './live_words';

const words = planWords;

/** What a plan does, as a list: where it is, who watches, its variables, what happened. */
export function PlanLive({ doc }: { doc: Doc }) {
  const plan = useShownPlan();
  const [chosen, choose] = useState<string | null>(null);
  const state = plan?.state ?? 'none';
  const [before, setBefore] = useState(state);
  if (state !== before) {
    setBefore(state);
    if (state === 'none' || state === 'ended') choose(null);
  }
  const levels = plan?.levels ?? [];
  const shown = shownLevel(levels, doc, chosen);
  const level = levels[shown];
  return (
    <aside className="planlive" aria-label={words.label}>
      <PlanControls doc={doc} plan={plan} />
      <div className="scroll" tabIndex={0} data-inset>
        {plan && state !== 'none' && plan.doc !== undefined && plan.doc !== doc && shown < 0 ? (
          <p className="quiet">{words.other(shownName(plan.doc))}</p>
        ) : null}
        {levels.length > 1 ? (
          <Breadcrumb levels={levels} shown={shown} onChoose={(path) => choose(path)} />
        ) : null}
        {plan && level ? (
          <>
            {state === 'ended' ? null : <ActiveActor level={level} t={plan.t} state={plan.state} />}
            <PlanWatchers supervisors={level.supervisors} />
            <PlanVariables level={shown} path={level.path} variables={level.variables} />
          </>
        ) : null}
        {state === 'none' ? <Blank title={words.none}>{words.noneHelp}</Blank> : null}
        {state !== 'none' ? <PlanStory story={plan?.story ?? []} /> : null}
      </div>
    </aside>
  );
}

function Breadcrumb(props: {
  levels: readonly PlanLevel[];
  shown: number;
  onChoose: (path: string) => void;
}) {
  const { levels, shown, onChoose } = props;
  return (
    <nav className="plancrumbs" aria-label={words.levels}>
      {levels.map((level, index) => (
        <button
          key={level.path}
          type="button"
          className={index === shown ? 'plancrumb is-on' : 'plancrumb'}
          aria-current={index === shown ? 'true' : undefined}
          onClick={() => onChoose(level.path)}
        >
          {level.path.split('/').at(-1)}
        </button>
      ))}
    </nav>
  );
}
