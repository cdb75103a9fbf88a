import { useId, useRef, type CSSProperties, type UIEvent } from 'react';
import type { Finding, PlanInput } from '../../../../protocol/messages';
import type { PlanBoard } from '../../../../core/plan/board';
import { feedSteps, shownFormula } from '../../../../core/plan/edit';
import { mistakeIn, type Span } from '../../../../core/plan/formula_place';
import type { Actor, Supervisor } from '../../../../core/plan/model';
import { useTopic } from '../../../hooks';
import { useDraft } from '../../../parts/use_draft';
import { Field } from '../../world/fields';
import { drawWords } from '../words';
import { offerId, Offers } from './offers';
import { Findings, isWrong, useFindingsAt } from './row_findings';
import { useCompletion } from './use_completion';
import { useDraftFindings } from './use_draft_findings';

/** One input: its formula; what counts without one is there in grey, what is wrong below it. */
export function FormulaField(props: {
  board: PlanBoard;
  element: Actor | Supervisor;
  input: PlanInput;
  disabled: boolean;
  /** The keyboard begins here. */
  isFirst: boolean;
}) {
  const { board, element, input, disabled, isFirst } = props;
  const list = useId();
  const sentence = useId();
  const field = useRef<HTMLInputElement>(null);
  const value = shownFormula(element.inputs[input.name]);
  const steps = (typed: string) => feedSteps(board.file.value, element.keys, input.name, typed);
  const draft = useDraft(value, (typed) => board.commit(steps(typed)));
  const words = useTopic('templates', {})?.formulas ?? [];
  const completion = useCompletion(field, board.model.variables, words, draft.set);
  const keys = [...element.keys, 'in', input.name];
  const typed = draft.typed === value ? null : draft.typed;
  const known = useFindingsAt(board.doc, keys);
  const found = useDraftFindings(board.doc, keys, typed === null ? null : steps(typed)) ?? known;
  const otherwise = input.default === undefined ? '' : shownFormula(input.default);
  const done = () => {
    completion.close();
    draft.done();
  };
  const { offers, chosen } = completion;
  const mistake = mistakeOf(draft.shown, found);
  const isUnfed = needsValue(element, input) && draft.typed === null;
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
                className={classOf(value, mistake)}
                style={styleOf(mistake)}
                onScroll={followText}
                title={input.help}
                data-autofocus={isFirst || undefined}
                data-plan-input={`${element.name}.${input.name}`}
                role="combobox"
                aria-autocomplete="list"
                aria-expanded={offers.length > 0}
                aria-controls={offers.length > 0 ? list : undefined}
                aria-activedescendant={offers[chosen] ? offerId(list, chosen) : undefined}
                aria-describedby={found.length > 0 ? sentence : undefined}
                aria-invalid={isUnfed || draft.isRefused || isWrong(found)}
                autoComplete="off"
                spellCheck={false}
                value={draft.shown}
                placeholder={otherwise === '' ? drawWords.unfed : drawWords.default(otherwise)}
                disabled={disabled}
                onChange={({ target }) => {
                  draft.set(target.value);
                  completion.typed(target.value, target.selectionStart ?? target.value.length);
                }}
                onBlur={done}
                onKeyDown={(event) => {
                  if (completion.key(event)) return;
                  if (event.key === 'Enter') done();
                  else draft.key(event);
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

/** Nothing feeds it, and it has no default. */
export function needsValue(
  { inputs }: Actor | Supervisor,
  { name, default: otherwise }: PlanInput,
) {
  return shownFormula(inputs[name]) === '' && otherwise === undefined;
}

/** The first mistake whose place is told. */
function mistakeOf(formula: string, found: readonly Finding[]): Span | null {
  for (const { what } of found) {
    const span = mistakeIn(formula, what);
    if (span) return span;
  }
  return null;
}

function classOf(value: string, mistake: Span | null): string {
  return `field field--small${value === '' ? ' is-default' : ''}${mistake ? ' is-marked' : ''}`;
}

function styleOf(mistake: Span | null): CSSProperties | undefined {
  return mistake ? ({ '--from': mistake.from, '--to': mistake.to } as CSSProperties) : undefined;
}

/** The line under the mistake moves with a text that is longer than its field. */
function followText({ currentTarget }: UIEvent<HTMLInputElement>): void {
  currentTarget.style.setProperty('--scrolled', `${currentTarget.scrollLeft}px`);
}
