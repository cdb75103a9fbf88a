import { useId } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import {
  kStart,
  targetsFor,
  type Actor,
  type Keys,
  type Outcome,
  type Supervisor,
} from '../../../../core/plan/model';
import { drawWords as words } from '../words';
import { targetName } from '../canvas/connect_menu';
import { Findings, isWrong, useFindingsAt } from './row_findings';

/** Where each state or event leads. */
export function Leads(props: {
  board: PlanBoard;
  source: string;
  outcomes: readonly Outcome[];
  disabled: boolean;
}) {
  const { board, source, outcomes, disabled } = props;
  const isSupervisor = board.supervisor(source) !== undefined;
  const title = isSupervisor ? words.events : source === kStart ? words.begins : words.states;
  return (
    <section className="planform__part" aria-label={title}>
      <h3>{title}</h3>
      {outcomes.map((one) => (
        <Lead key={one.name} board={board} source={source} outcome={one} disabled={disabled} />
      ))}
    </section>
  );
}

function Lead(props: { board: PlanBoard; source: string; outcome: Outcome; disabled: boolean }) {
  const { board, source, outcome, disabled } = props;
  const id = useId();
  const element = board.element(source);
  const targets = element
    ? targetsFor(board.model, element)
    : board.model.actors.map((one) => one.name);
  const { target } = outcome;
  const sentence = useId();
  const found = useFindingsAt(board.doc, leadKeys(element, outcome.name));
  const isKnown = target === null || targets.includes(target);
  return (
    <>
      <div className="planlead">
        <label htmlFor={id} className="ellipsis" title={outcome.help}>
          {outcome.name || words.first}
        </label>
        <span aria-hidden>→</span>
        <select
          id={id}
          className="field field--small field--ui"
          value={target ?? ''}
          disabled={disabled}
          aria-invalid={target === null || !isKnown || isWrong(found)}
          aria-describedby={found.length > 0 ? sentence : undefined}
          onChange={(event) => board.connect(source, outcome.name, event.target.value || null)}
        >
          <option value="">{words.nowhere}</option>
          {isKnown ? null : <option value={target}>{target}</option>}
          {targets.map((one) => (
            <option key={one} value={one}>
              {targetName(one)}
            </option>
          ))}
        </select>
      </div>
      <Findings id={sentence} findings={found} />
    </>
  );
}

/** Where the file says what a state or event leads to. */
function leadKeys(element: Actor | Supervisor | undefined, outcome: string): Keys {
  if (!element) return ['start', 'actor'];
  return [...element.keys, 'owner' in element ? 'events' : 'states', outcome];
}
