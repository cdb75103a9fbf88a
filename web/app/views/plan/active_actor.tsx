import type { PlanLevel, Topics } from '../../../protocol/messages';
import { valueOf } from '../../../core/plan_view';
import { text } from '../../text';

const words = text.plan;

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
      ) : null}
    </section>
  );
}
