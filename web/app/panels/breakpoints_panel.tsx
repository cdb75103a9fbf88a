import { useTopic } from '../hooks';
import { Quiet } from '../parts/blank';
import { text } from '../text';
import { ConditionForm } from './breakpoints/condition_form';
import { HeldEvents } from './breakpoints/held_events';
import { PlanRow } from './breakpoints/plan_row';
import { ScriptRow } from './breakpoints/script_row';
import { breakWords } from './breakpoints/words';
import '../look/lists.css';

/** All breakpoints, of plans and of scripts; the disc tells whether one is on. */
export default function BreakpointsPanel() {
  const all = useTopic('breakpoints', {});
  const scripts = all?.breakpoints ?? [];
  const plans = all?.plans ?? [];
  return (
    <div className="scroll">
      {scripts.length + plans.length === 0 ? <Quiet>{breakWords.none}</Quiet> : null}
      <ul aria-label={text.panels.breakpoints}>
        {plans.map((one) => (
          <PlanRow key={one.number} one={one} />
        ))}
        {[...scripts]
          .sort((a, b) => (a.doc < b.doc ? -1 : a.doc > b.doc ? 1 : a.line - b.line))
          .map((one) => (
            <ScriptRow key={`${one.doc}:${one.line}`} one={one} />
          ))}
      </ul>
      <ConditionForm />
      <HeldEvents />
    </div>
  );
}
