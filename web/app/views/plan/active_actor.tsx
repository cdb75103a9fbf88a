import type { PlanLevel, Topics } from '../../../protocol/messages';
import { aheadText, inputsAhead } from '../../../core/plan/ahead';
import { shownValue } from '../../../core/plan/live';
import { valueOf } from '../../../core/plan_view';
import { useStudio } from '../../hooks';
import { usePlanDesk } from './plan_desk';
import { planWords } from './live_words';

const words = planWords;

/** The actor that works at the moment, since when, and with what. */
export function ActiveActor(props: {
  level: PlanLevel;
  t: number;
  state: Topics['plan']['is']['state'];
}) {
  const { level, t, state } = props;
  const inputs = Object.entries(
    typeof level.inputs === 'object' && level.inputs !== null ? level.inputs : {},
  );
  return (
    <section className="planlive__part">
      <div className={level.actor && state === 'running' ? 'active is-running' : 'active'}>
        <div className="grow">
          <b className="active__name ellipsis">{level.actor || words.noActor}</b>
          <span className="active__template ellipsis">
            {level.template}
            {level.activation > 0 ? ` · ${words.activation(level.activation)}` : ''}
          </span>
        </div>
        <span className="active__since num">
          {words.since(Math.max(0, t - level.since).toFixed(1))}
        </span>
      </div>
      {inputs.length > 0 ? (
        <p className="active__inputs">
          {inputs.map(([name, value]) => `${name} ${valueOf(value)}`).join(' · ')}
        </p>
      ) : (
        <Ahead level={level} />
      )}
    </section>
  );
}

/** Paused before it begins, it has taken nothing yet: its formulas, if its plan is drawn. */
function Ahead({ level }: { level: PlanLevel }) {
  const { shown } = usePlanDesk(useStudio());
  const model = shown?.board.doc === level.doc ? shown.board.model : undefined;
  const ahead = inputsAhead(model?.actors.find((one) => one.name === level.actor));
  if (ahead.length === 0) return null;
  const values = new Map(level.variables.map(({ name, value }) => [name, shownValue(value)]));
  return <p className="active__inputs">{aheadText(ahead, values)}</p>;
}
