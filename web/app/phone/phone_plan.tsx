import { useTopic } from '../hooks';
import { Blank } from '../parts/blank';
import { ActiveActor } from '../views/plan/active_actor';
import { PlanStory } from '../views/plan/plan_story';
import { PlanVariables } from '../views/plan/plan_variables';
import { PlanWatchers } from '../views/plan/plan_watchers';
import { planWords } from '../views/plan/live_words';
import '../look/plan.css';
import { phoneWords } from './words';

const words = planWords;

/** What the plan does: its active actor, who watches, its variables, what happened. */
export default function PhonePlan() {
  const plan = useTopic('plan', {});
  const levels = plan?.levels ?? [];
  const last = levels.length - 1;
  const level = levels[last];
  if (!plan || plan.state === 'none') return <Blank title={words.none}>{phoneWords.noPlan}</Blank>;
  return (
    <div
      className="scroll phone__plan"
      tabIndex={0}
      data-inset
      aria-label={words.label}
      role="group"
    >
      {levels.length > 1 ? (
        <p className="phone__path">{levels.map((one) => one.path.split('/').at(-1)).join(' › ')}</p>
      ) : null}
      {level ? (
        <>
          <ActiveActor level={level} t={plan.t} state={plan.state} />
          <PlanWatchers supervisors={level.supervisors} />
          <PlanVariables level={last} path={level.path} variables={level.variables} />
        </>
      ) : null}
      {plan.state === 'ended' && plan.result ? (
        <p className="phone__path">
          {words.results[plan.result]} {plan.message ?? ''}
        </p>
      ) : null}
      <PlanStory story={plan.story} />
    </div>
  );
}
