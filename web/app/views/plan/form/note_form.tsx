import type { PlanBoard } from '../../../../core/plan/board';
import type { Note } from '../../../../core/plan/model';
import { kNoteLeast, resizeNote, writeNote, type Size } from '../../../../core/plan/notes';
import { kSnap } from '../../../../core/plan/place';
import { useDraft } from '../../../parts/use_draft';
import { Field } from '../../world/fields';
import { NumberField } from '../../world/number_field';
import { drawWords as words } from '../words';

/** A note by the keyboard: its text, how wide and high it is. */
export function NoteForm(props: { board: PlanBoard; note: Note; disabled: boolean }) {
  const { board, note, disabled } = props;
  const [width, height] = note.size;
  const measure = (label: string, value: number, least: number, size: (to: number) => Size) => (
    <NumberField
      label={label}
      unit="px"
      low={least}
      step={kSnap}
      value={value}
      disabled={disabled}
      onSet={(to) => to !== undefined && board.commit(resizeNote(note, size(to)))}
    />
  );
  return (
    <section className="planform__part" aria-label={words.note}>
      <Field label={words.noteText}>
        {(id) => (
          <Written
            id={id}
            value={note.text}
            disabled={disabled}
            onSet={(typed) => board.commit(writeNote(note, typed))}
          />
        )}
      </Field>
      {measure(words.width, width, kNoteLeast.width, (to) => ({ width: to, height }))}
      {measure(words.height, height, kNoteLeast.height, (to) => ({ width, height: to }))}
    </section>
  );
}

function Written(props: {
  id: string;
  value: string;
  disabled: boolean;
  onSet: (typed: string) => boolean;
}) {
  const { id, value, disabled, onSet } = props;
  const draft = useDraft(value, onSet);
  return (
    <textarea
      id={id}
      className="field planform__note"
      rows={4}
      value={draft.shown}
      disabled={disabled}
      aria-invalid={draft.isRefused}
      onChange={(event) => draft.set(event.target.value)}
      onBlur={draft.done}
      onKeyDown={(event) => event.key === 'Escape' && draft.key(event)}
    />
  );
}
