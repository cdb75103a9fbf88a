import { useId } from 'react';
import type { PlanInput } from '../../../../protocol/messages';
import type { PlanBoard } from '../../../../core/plan/board';
import { keepSteps } from '../../../../core/plan/edit';
import { textOf } from '../../../../core/plan/json';
import type { Actor, Supervisor } from '../../../../core/plan/model';
import { Quiet } from '../../../parts/blank';
import { drawWords as words } from '../words';
import { Field } from '../../world/fields';
import { FormulaField, needsValue } from './formula_field';
import { Leads } from './leads';
import { ElementFindings, Findings, isWrong, useFindingsAt } from './row_findings';

/** Inputs, outputs, and where the states or events of an element lead. */
export function ElementForm(props: {
  board: PlanBoard;
  chosen: string;
  element: Actor | Supervisor;
  disabled: boolean;
}) {
  const { board, chosen, element, disabled } = props;
  const inputs = inputsOf(element);
  const first = inputs.find((input) => needsValue(element, input)) ?? inputs[0];
  return (
    <>
      <ElementFindings doc={board.doc} keys={element.keys} />
      <section className="planform__part" aria-label={words.inputs}>
        <h3>{words.inputs}</h3>
        {inputs.map((input) => (
          <FormulaField
            key={input.name}
            board={board}
            element={element}
            input={input}
            disabled={disabled}
            isFirst={input === first}
          />
        ))}
        {inputs.length === 0 ? <Quiet>{words.noInputs}</Quiet> : null}
      </section>
      <Outputs board={board} element={element} disabled={disabled} />
      <Leads board={board} source={chosen} outcomes={element.outcomes} disabled={disabled} />
    </>
  );
}

/** Those of the template, then what only the file names. */
function inputsOf(element: Actor | Supervisor): PlanInput[] {
  const known = element.known?.inputs ?? [];
  const more = Object.keys(element.inputs).filter(
    (name) => !known.some((one) => one.name === name),
  );
  return [...known, ...more.map((name): PlanInput => ({ name, type: 'any', unit: '', help: '' }))];
}

function Outputs(props: { board: PlanBoard; element: Actor | Supervisor; disabled: boolean }) {
  const { board, element, disabled } = props;
  const known = element.known?.outputs.map((one) => one.name) ?? [];
  const names = [...new Set([...known, ...Object.keys(element.outputs)])];
  if (names.length === 0) return null;
  return (
    <section className="planform__part" aria-label={words.outputs}>
      <h3>{words.outputs}</h3>
      {names.map((name) => (
        <Output key={name} board={board} element={element} name={name} disabled={disabled} />
      ))}
    </section>
  );
}

function Output(props: {
  board: PlanBoard;
  element: Actor | Supervisor;
  name: string;
  disabled: boolean;
}) {
  const { board, element, name, disabled } = props;
  const sentence = useId();
  const found = useFindingsAt(board.doc, [...element.keys, 'out', name]);
  const value = textOf(element.outputs[name]);
  const isKnown = value === '' || board.model.variables.some((one) => one.name === value);
  return (
    <>
      <Field label={name}>
        {(id) => (
          <select
            id={id}
            className="field field--small field--ui"
            value={value}
            disabled={disabled}
            aria-invalid={isWrong(found)}
            aria-describedby={found.length > 0 ? sentence : undefined}
            onChange={(event) =>
              board.commit(keepSteps(board.file.value, element.keys, name, event.target.value))
            }
          >
            <option value="">{words.dropped}</option>
            {isKnown ? null : <option value={value}>{value}</option>}
            {board.model.variables.map((one) => (
              <option key={one.name} value={one.name}>
                {one.name}
              </option>
            ))}
          </select>
        )}
      </Field>
      <Findings id={sentence} findings={found} />
    </>
  );
}
