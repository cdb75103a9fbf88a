import { NodeResizeControl, type Node, type NodeProps } from '@xyflow/react';
import { memo, useContext, useEffect, useState } from 'react';
import type { Note as PlanNote } from '../../../../core/plan/model';
import { kNoteLeast, noteKey } from '../../../../core/plan/notes';
import { useStudio } from '../../../hooks';
import { useDraft } from '../../../parts/use_draft';
import { drawWords as words } from '../words';
import { planDeskOf } from '../plan_desk';
import { NoteContext } from './note_context';

export type NoteNode = Node<{ note: PlanNote }, 'note'>;

/** What a person wrote beside the plan: written in place, dragged, drawn larger at its corner. */
export const NoteCard = memo(function NoteCard({ data, selected }: NodeProps<NoteNode>) {
  const { note } = data;
  const notes = useContext(NoteContext);
  const desk = planDeskOf(useStudio());
  const key = noteKey(note.index);
  // A new one is written at once.
  const [isWritten, write] = useState(note.text === '' && selected && notes !== null);
  useEffect(
    () => (selected && notes ? desk.onRename(() => write(true)) : undefined),
    [desk, selected, notes],
  );
  return (
    <div
      className={selected ? 'pnote is-selected' : 'pnote'}
      onDoubleClick={() => notes && write(true)}
    >
      {isWritten ? (
        <Editor
          note={note}
          // While nothing may be changed, what is typed stays in the field.
          onWrite={(typed) => notes?.write(key, typed) ?? false}
          onEnd={() => write(false)}
        />
      ) : (
        <p className={note.text === '' ? 'pnote__text muted' : 'pnote__text'}>
          {note.text === '' ? words.emptyNote : note.text}
        </p>
      )}
      {notes ? (
        <NodeResizeControl
          className="pnote__corner"
          position="bottom-right"
          minWidth={kNoteLeast.width}
          minHeight={kNoteLeast.height}
          onResize={(_event, { width, height }) => notes.hold(key, { width, height })}
          onResizeEnd={() => notes.letGo()}
        />
      ) : null}
    </div>
  );
});

function Editor(props: { note: PlanNote; onWrite: (typed: string) => boolean; onEnd: () => void }) {
  const { note, onWrite, onEnd } = props;
  const draft = useDraft(note.text, onWrite);
  const done = () => draft.done() && (onEnd(), true);
  return (
    <textarea
      className="pnote__editor nodrag nopan nowheel"
      aria-label={words.noteText}
      maxLength={kTextMax}
      autoFocus
      aria-invalid={draft.isRefused}
      value={draft.shown}
      onFocus={({ target }) => target.setSelectionRange(target.value.length, target.value.length)}
      onChange={(event) => draft.set(event.target.value)}
      onBlur={done}
      onKeyDown={(event) => {
        const card = event.currentTarget.closest<HTMLElement>('.react-flow__node');
        const isEnd = event.key === 'Enter' && event.ctrlKey;
        if (!isEnd && event.key !== 'Escape') return;
        event.preventDefault();
        if (isEnd && !done()) return;
        if (!isEnd) {
          draft.set(null);
          onEnd();
        }
        card?.focus();
      }}
    />
  );
}

/** Enough for a page; a file is not a book. */
const kTextMax = 4000;
