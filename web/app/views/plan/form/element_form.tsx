import type { PlanInput } from '../../../../protocol/messages';
import type { PlanBoard } from '../../../../core/plan/board';
import { feedSteps, keepSteps, shownFormula } from '../../../../core/plan/edit';
import { textOf } from '../../../../core/plan/json';
import type { Actor, Supervisor } from '../../../../core/plan/model';
import { Quiet } from '../../../parts/blank';
import { text } from '../../../text';
import { Field } from '../../world/fields';
import { FormulaField } from './formula_field';
import { Leads } from './leads';

const words = text.draw;

/** Inputs, outputs, and where the states or events of an element lead. */
export function ElementForm(props: {
  board: PlanBoard;
  chosen: string;
  element: Actor | Supervisor;
  disabled: boolean;
}) {
  const { board, chosen, element, disabled } = props;
  return (
    <>
      <section className="planform__part" aria-label={words.inputs}>
        <h3>{words.inputs}</h3>
        {inputsOf(element).map((input) => (
          <FormulaField
            key={input.name}
            input={input}
            value={shownFormula(element.inputs[input.name])}
            variables={board.model.variables.map((one) => one.name)}
            disabled={disabled}
            onSet={(typed) =>
              board.commit(feedSteps(board.file.value, element.keys, input.name, typed))
            }
          />
        ))}
        {inputsOf(element).length === 0 ? <Quiet>{words.noInputs}</Quiet> : null}
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
        <Field key={name} label={name}>
          {(id) => (
            <select
              id={id}
              className="field field--small field--ui"
              value={textOf(element.outputs[name])}
              disabled={disabled}
              onChange={(event) =>
                board.commit(keepSteps(board.file.value, element.keys, name, event.target.value))
              }
            >
              <option value="">{words.dropped}</option>
              {board.model.variables.map((one) => (
                <option key={one.name} value={one.name}>
                  {one.name}
                </option>
              ))}
            </select>
          )}
        </Field>
      ))}
    </section>
  );
}
