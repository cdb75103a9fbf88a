import { valueOf, variableNamed } from '../../../core/plan_view';
import type { Pick } from '../../../core/picks';
import { useShownPlan } from '../../past_hooks';
import { text } from '../../text';
import { PickButtons } from './pick_buttons';

const words = text.variables;

/** A variable of the plan among those of nodes. It is changed in the panel of the plan. */
export function PlanLine({ pick }: { pick: Pick }) {
  const variable = variableNamed(useShownPlan()?.levels ?? [], pick.name);
  return (
    <div className={variable ? 'variable' : 'variable variable--missing'}>
      <span className="variable__dot" aria-hidden />
      <code className="ellipsis">{pick.name}</code>
      {variable ? (
        <span className="value num">{valueOf(variable.value)}</span>
      ) : (
        <span className="muted ellipsis">{words.noPlan}</span>
      )}
      <span className="variable__unit ellipsis">{variable?.unit ?? ''}</span>
      <PickButtons pick={pick} size={1} inWatch />
    </div>
  );
}
