import { useState } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import type { Note } from '../../../../core/plan/model';
import { kNoteLeast, resizeNote, writeNote } from '../../../../core/plan/notes';
import { kSnap } from '../../../../core/plan/place';
import { Field } from '../../world/fields';
import { text } from '../../../text';

const words = text.draw;

/** A note by the keyboard: its text, how wide and high it is. */
export function NoteForm(props: { board: PlanBoard; note: Note; disabled: boolean }) {
  const { board, note, disabled } = props;
  const [width, height] = note.size;
  return (
    <section className="planform__part" aria-label={words.note}>
      <Field label={words.noteText}>
        {(id) => (
          <Written
            key={note.text}
            id={id}
            value={note.text}
            disabled={disabled}
            onSet={(typed) => board.commit(writeNote(note, typed))}
          />
        )}
      </Field>
      <Measure
        label={words.width}
        value={width}
        least={kNoteLeast.width}
        disabled={disabled}
        onSet={(to) => board.commit(resizeNote(note, { width: to, height }))}
      />
      <Measure
        label={words.height}
        value={height}
        least={kNoteLeast.height}
        disabled={disabled}
        onSet={(to) => board.commit(resizeNote(note, { width, height: to }))}
      />
    </section>
  );
}

function Written(props: {
  id: string;
  value: string;
  disabled: boolean;
  onSet: (typed: string) => void;
}) {
  const { id, value, disabled, onSet } = props;
  const [typed, type] = useState(value);
  return (
    <textarea
      id={id}
      className="field planform__note"
      rows={4}
      value={typed}
      disabled={disabled}
      onChange={(event) => type(event.target.value)}
      onBlur={() => onSet(typed)}
    />
  );
}

function Measure(props: {
  label: string;
  value: number;
  least: number;
  disabled: boolean;
  onSet: (to: number) => void;
}) {
  const { label, value, least, disabled, onSet } = props;
  return (
    <Field label={label} unit="px">
      {(id) => (
        <input
          id={id}
          type="number"
          className="field field--small num"
          min={least}
          step={kSnap}
          value={value}
          disabled={disabled}
          onChange={({ target }) => {
            if (Number.isFinite(target.valueAsNumber)) onSet(target.valueAsNumber);
          }}
        />
      )}
    </Field>
  );
}
