import { useId, useState } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import { findInPlan } from '../../../../core/plan/find';
import { drawWords as words } from '../words';

/** Looks for an element by what is typed: arrows and Enter choose, Escape goes back. */
export function FindBar(props: {
  board: PlanBoard;
  /** Brings the keyboard, and what is seen, to an element. */
  focus: (key: string) => void;
  onClose: () => void;
}) {
  const { board, focus, onClose } = props;
  const list = useId();
  const [typed, type] = useState('');
  const [at, move] = useState(0);
  const hits = findInPlan(board.model, typed, words.start);
  const chosen = hits[Math.min(at, hits.length - 1)];
  const onFound = (key: string) => {
    onClose();
    board.select(key);
    focus(key);
  };
  const keys: Record<string, () => void> = {
    ArrowDown: () => move(Math.min(at + 1, hits.length - 1)),
    ArrowUp: () => move(Math.max(at - 1, 0)),
    Enter: () => chosen && onFound(chosen.key),
    Escape: onClose,
  };
  return (
    <div className="pfind">
      <input
        className="field field--small"
        role="combobox"
        aria-label={words.find}
        aria-expanded={hits.length > 0}
        aria-controls={list}
        aria-activedescendant={chosen ? `${list}-${chosen.key}` : undefined}
        placeholder={words.find}
        autoFocus
        autoComplete="off"
        spellCheck={false}
        value={typed}
        onChange={(event) => {
          type(event.target.value);
          move(0);
        }}
        onKeyDown={(event) => {
          const act = keys[event.key];
          if (!act) return;
          event.preventDefault();
          event.stopPropagation();
          act();
        }}
        onBlur={onClose}
      />
      <ul id={list} role="listbox" aria-label={words.found} className="pfind__list">
        {hits.map((hit) => (
          <li
            key={hit.key}
            id={`${list}-${hit.key}`}
            role="option"
            aria-selected={hit === chosen}
            className="pfind__hit"
            // Before the field loses the focus and all of this goes.
            onPointerDown={(event) => {
              event.preventDefault();
              onFound(hit.key);
            }}
          >
            <b className="ellipsis">{hit.name}</b>
            <span className="muted ellipsis">{hit.about}</span>
          </li>
        ))}
      </ul>
      {typed.trim() !== '' && hits.length === 0 ? (
        <p className="pfind__none muted">{words.notFound(typed)}</p>
      ) : null}
    </div>
  );
}
