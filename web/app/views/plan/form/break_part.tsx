import { useState } from 'react';
import type { PlanBreakpoint } from '../../../../protocol/messages';
import type { PlanBoard } from '../../../../core/plan/board';
import { arrowId } from '../../../../core/plan/arrows';
import { discOf, isAt, placeOf } from '../../../../core/plan/breaks';
import { mistakeIn } from '../../../../core/condition';
import { useStudio, useTopic } from '../../../hooks';
import { useTyped } from '../../../parts/use_draft';
import { text } from '../../../text';
import { drawWords } from '../words';
import { changeBreak, setBreak, toggleBreak } from '../break_acts';
import { whyOf } from '../../../../core/why';
import '../../../look/lists.css';

const words = drawWords.break;

/** Where a plan can stop at an element: before an actor, at each of its states, at each event. */
export function BreakPart(props: {
  board: PlanBoard;
  chosen: string;
  outcomes: readonly { name: string }[];
  disabled: boolean;
}) {
  const { board, chosen, outcomes, disabled } = props;
  const own = placeOf(board.model, chosen);
  const rows = outcomes.map(({ name }) => arrowId(chosen, name));
  // The only event of a supervisor is the supervisor's own place.
  const keys =
    own?.kind === 'event' ? (rows.length === 1 ? rows : [chosen, ...rows]) : [chosen, ...rows];
  return (
    <section className="planform__part" aria-label={words.title}>
      <h3>{words.title}</h3>
      {keys.map((key) => (
        <Place key={key} board={board} at={key} disabled={disabled} />
      ))}
    </section>
  );
}

function Place({ board, at, disabled }: { board: PlanBoard; at: string; disabled: boolean }) {
  const studio = useStudio();
  const place = placeOf(board.model, at);
  const there = useTopic('breakpoints', {})?.plans.find(
    (one) => one.doc === board.doc && place !== null && isAt(one, place),
  );
  if (!place) return null;
  return (
    <div className="breakplace">
      <button
        type="button"
        className="breakplace__toggle"
        aria-pressed={there !== undefined}
        disabled={disabled}
        onClick={() => toggleBreak(studio, board, at)}
      >
        <span className={`disc disc--${there ? discOf(there) : 'none'}`} aria-hidden />
        <span className="ellipsis">{words.stops(place)}</span>
        {there ? <span className="muted num">{text.editor.hits(there.hits)}</span> : null}
      </button>
      {there ? <Details key={there.number} one={there} disabled={disabled} /> : null}
    </div>
  );
}

/** When it stops; told once a field is left, or with Enter. */
function Details({ one, disabled }: { one: PlanBreakpoint; disabled: boolean }) {
  const studio = useStudio();
  const [condition, setCondition] = useState(one.condition);
  const [count, setCount] = useState(String(one.stop_at));
  const [tried, setTried] = useState('');
  const [refused, setRefused] = useState('');
  const wrong = mistakeIn(condition);
  const told = tried === condition ? wrong || refused : '';
  const good = /^[1-9]\d{0,8}$/.test(count);
  const isTyped = condition.trim() !== one.condition || count !== String(one.stop_at);
  const save = () => {
    setTried(condition);
    if (!good || wrong !== '') return false;
    const to = { condition: condition.trim(), stop_at: Number(count) };
    setRefused('');
    if (isTyped) setBreak(studio, one, to).catch((problem: unknown) => setRefused(whyOf(problem)));
    return true;
  };
  useTyped(isTyped, save);
  return (
    <form
      className="breakplace__when"
      onSubmit={(event) => (event.preventDefault(), save())}
      onBlur={save}
    >
      <label>
        {text.editor.condition}
        <input
          className="field field--small"
          placeholder={words.conditionHint}
          value={condition}
          aria-invalid={told !== ''}
          spellCheck={false}
          disabled={disabled}
          onChange={(event) => setCondition(event.target.value)}
        />
      </label>
      <label className="breakplace__count">
        {words.from}
        <input
          className="field field--small num"
          inputMode="numeric"
          value={count}
          aria-invalid={!good}
          disabled={disabled}
          onChange={(event) => setCount(event.target.value)}
        />
      </label>
      <label className="form__check">
        <input
          type="checkbox"
          checked={one.enabled}
          disabled={disabled}
          onChange={(event) => changeBreak(studio, one, { enabled: event.target.checked })}
        />
        {text.editor.enabled}
      </label>
      {told || one.why ? <p className="planform__why">{told || one.why}</p> : null}
      <button type="submit" hidden />
    </form>
  );
}
