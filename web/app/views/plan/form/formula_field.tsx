import { useId, useRef, useState } from 'react';
import type { PlanInput } from '../../../../protocol/messages';
import type { PlanBoard } from '../../../../core/plan/board';
import { feedSteps, shownFormula } from '../../../../core/plan/edit';
import type { Actor, Supervisor } from '../../../../core/plan/model';
import { useTopic } from '../../../hooks';
import { Field } from '../../world/fields';
import { text } from '../../../text';
import { offerId, Offers } from './offers';
import { Findings, isWrong, useFindingsAt } from './row_findings';
import { useCompletion } from './use_completion';
import { useDraftFindings } from './use_draft_findings';

/** One input: its formula; what counts without one stands there in grey, what is wrong below it. */
export function FormulaField(props: {
  board: PlanBoard;
  element: Actor | Supervisor;
  input: PlanInput;
  disabled: boolean;
}) {
  const { board, element, input, disabled } = props;
  const list = useId();
  const sentence = useId();
  const field = useRef<HTMLInputElement>(null);
  const [draft, setDraft] = useState<string | null>(null);
  const words = useTopic('templates', {})?.formulas ?? [];
  const completion = useCompletion(field, board.model.variables, words, setDraft);
  const value = shownFormula(element.inputs[input.name]);
  const steps = (typed: string) => feedSteps(board.file.value, element.keys, input.name, typed);
  const keys = [...element.keys, 'in', input.name];
  const isTyped = draft !== null && draft !== value;
  const known = useFindingsAt(board.doc, keys);
  const found = useDraftFindings(board.doc, keys, isTyped ? steps(draft) : null) ?? known;
  const otherwise = input.default === undefined ? '' : shownFormula(input.default);
  const done = () => {
    completion.close();
    if (isTyped) board.commit(steps(draft));
    setDraft(null);
  };
  const { offers, chosen } = completion;
  const isUnfed = value === '' && input.default === undefined && draft === null;
  return (
    <>
      <Field label={input.name} unit={input.unit}>
        {(id) => (
          <Offers
            id={list}
            offers={offers}
            chosen={chosen}
            onTake={completion.take}
            field={
              <input
                ref={field}
                id={id}
                className={value === '' ? 'field field--small is-default' : 'field field--small'}
                title={input.help}
                role="combobox"
                aria-autocomplete="list"
                aria-expanded={offers.length > 0}
                aria-controls={offers.length > 0 ? list : undefined}
                aria-activedescendant={offers[chosen] ? offerId(list, chosen) : undefined}
                aria-describedby={found.length > 0 ? sentence : undefined}
                aria-invalid={isUnfed || isWrong(found)}
                autoComplete="off"
                spellCheck={false}
                value={draft ?? value}
                placeholder={otherwise === '' ? text.draw.unfed : text.draw.default(otherwise)}
                disabled={disabled}
                onChange={({ target }) => {
                  setDraft(target.value);
                  completion.typed(target.value, target.selectionStart ?? target.value.length);
                }}
                onBlur={done}
                onKeyDown={(event) => {
                  if (completion.key(event)) return;
                  if (event.key === 'Enter') done();
                  else if (event.key === 'Escape') setDraft(null);
                }}
              />
            }
          />
        )}
      </Field>
      <Findings id={sentence} findings={found} />
    </>
  );
}
