import type { EditorView } from '@codemirror/view';
import { useLayoutEffect, useRef, type ReactNode } from 'react';
import type { Doc } from '../../../protocol/messages';
import { update } from '../../../core/window_state';
import { useStudio, useWindow } from '../../hooks';
import { text } from '../../text';
import { BreakpointForm } from './breakpoint_form';
import { RenameForm } from './rename_form';

const words = text.editor;

/** A small form at a line: a new name, or when a breakpoint stops. */
export function EditorForm({ doc, view }: { doc: Doc; view: EditorView }) {
  const { window: store } = useStudio();
  const form = useWindow((state) => (state.form?.doc === doc ? state.form : null));
  if (!form) return null;
  const end = () => {
    update(store, (draft) => void (draft.form = null));
    view.focus();
  };
  return (
    <Frame
      view={view}
      line={form.line}
      label={form.is === 'rename' ? text.commands['edit.rename'] : words.breakpoint(form.line)}
      onEnd={end}
    >
      {form.is === 'rename' ? (
        <RenameForm doc={doc} view={view} onEnd={end} />
      ) : (
        <BreakpointForm doc={doc} line={form.line} onEnd={end} />
      )}
    </Frame>
  );
}

/** Is below its line. */
function Frame({
  view,
  line,
  label,
  onEnd,
  children,
}: {
  view: EditorView;
  line: number;
  label: string;
  onEnd(): void;
  children: ReactNode;
}) {
  const form = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const at = view.state.doc.line(Math.min(line, view.state.doc.lines)).from;
    const place = view.coordsAtPos(at);
    const frame = view.dom.getBoundingClientRect();
    const below = place ? place.bottom - frame.top + 4 : 40;
    const top = Math.min(Math.max(below, 8), Math.max(frame.height - 150, 8));
    if (form.current) form.current.style.top = `${top}px`;
  }, [view, line]);
  return (
    <div
      className="lineform menu"
      ref={form}
      role="dialog"
      aria-label={label}
      onKeyDown={(event) => event.key === 'Escape' && (event.stopPropagation(), onEnd())}
      onBlur={(event) => event.currentTarget.contains(event.relatedTarget) || onEnd()}
    >
      {children}
    </div>
  );
}
