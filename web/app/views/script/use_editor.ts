// The life of an editor: made from the shared text, kept in step with it, told what others know.

import {
  Annotation,
  type EditorState,
  Transaction,
  type TransactionSpec,
  type StateEffect,
} from '@codemirror/state';
import { EditorView, type ViewUpdate } from '@codemirror/view';
import { useEffect, useRef, useState, type RefObject } from 'react';
import type { Doc } from '../../../protocol/messages';
import type { OpenDocument } from '../../../core/documents';
import type { Typed } from '../../../core/session/text_session';
import { readSettings } from '../../../core/settings';
import type { Studio } from '../../../core/studio';
import { textDiff } from '../../../core/text_diff';
import { update } from '../../../core/window_state';
import { nameOf } from '../../documents';
import { useStudio } from '../../hooks';
import { text } from '../../text';
import { assist } from './assist';
import { goToDefinition } from './editor_acts';
import { findingsExtension } from './findings';
import { lineMarks } from './line_marks';
import { revealSentence } from './reveal_sentence';
import { backKeys, makeState } from './setup';
import { editBreakpoint, toggleBreakpoint } from './editor_acts';
import { placeOf } from './places';
import { whyOf } from '../../../core/why';

/** Undo is the session's: the editor only shows what it does. */
const fromSession = Annotation.define<boolean>();

export interface EditorLife {
  host: RefObject<HTMLDivElement | null>;
  view: EditorView | null;
  failed: string | null;
  retry(): void;
}

export function useEditor(doc: Doc): EditorLife {
  const studio = useStudio();
  const host = useRef<HTMLDivElement>(null);
  const [view, setView] = useState<EditorView | null>(null);
  const [failed, setFailed] = useState<string | null>(null);
  const [tries, setTries] = useState(0);
  // A file that was renamed to this name is another one than what was open under it.
  useEffect(
    () => studio.documents.moved.on(({ to }) => to === doc && setTries((before) => before + 1)),
    [studio, doc],
  );
  useEffect(() => {
    const held = studio.documents.acquire(doc);
    let end = () => {};
    let gone = false;
    held.opened.then(
      (opened) => {
        if (gone || !host.current) return;
        const made = attach(studio, doc, opened, host.current);
        end = made.end;
        setView(made.view);
      },
      (problem: unknown) => gone || setFailed(whyOf(problem)),
    );
    return () => {
      gone = true;
      setView(null);
      setFailed(null);
      end();
      held.release();
    };
  }, [studio, doc, tries]);
  // Its place has to be there again before it can be shown: the effect runs behind that.
  const retry = () => {
    setFailed(null);
    setTries(tries + 1);
  };
  return { host, view, failed, retry };
}

function attach(
  studio: Studio,
  doc: Doc,
  opened: OpenDocument,
  parent: HTMLElement,
): { view: EditorView; end: () => void } {
  const { session } = opened;
  const view: EditorView = new EditorView({
    parent,
    state: stateFor(studio, doc, opened),
    dispatchTransactions(transactions) {
      view.update(transactions);
      for (const one of transactions)
        if (one.docChanged && !one.annotation(fromSession)) session.type(typedIn(view, one));
    },
  });
  const late = textDiff(view.state.doc.toString(), session.text);
  if (late.length > 0) view.dispatch(followed({ changes: late }));
  const end = session.followed.on(({ changes, from, selection }) => {
    if (from === view || changes.empty) return;
    // Undo leads the caret to where it was, in the editor that has the keyboard.
    const leads = view.hasFocus && selection !== undefined;
    view.dispatch(followed(leads ? { changes, selection, scrollIntoView: true } : { changes }));
  });
  return {
    view,
    end() {
      end();
      opened.kept = { doc, state: view.state } satisfies Kept;
      view.destroy();
    },
  };
}

function typedIn(view: EditorView, one: Transaction): Typed {
  return {
    changes: one.changes,
    at: Date.now(),
    from: view,
    before: one.startState.selection,
    after: one.newSelection,
    userEvent: one.annotation(Transaction.userEvent),
  };
}

function followed(spec: TransactionSpec): TransactionSpec {
  return { ...spec, annotations: fromSession.of(true) };
}

/** An editor's state; its parts are for the name that the document had then. */
interface Kept {
  doc: Doc;
  state: EditorState;
}

function stateFor(studio: Studio, doc: Doc, opened: OpenDocument): EditorState {
  // Kept by an editor of this same document, here above.
  const kept = opened.kept as Kept | null;
  if (kept?.doc === doc) return kept.state;
  const made = newState(studio, doc, opened, kept?.state.doc.toString() ?? opened.session.text);
  return kept ? made.update({ selection: kept.state.selection }).state : made;
}

function newState(studio: Studio, doc: Doc, opened: OpenDocument, shown: string): EditorState {
  const isScript = doc.includes('#');
  const name = nameOf(studio, doc);
  const extensions = [
    backKeys(studio.registry.isApple, (act) => opened.session[act]()),
    EditorView.updateListener.of((change) => tellCursor(studio, doc, change)),
    findingsExtension,
    revealSentence,
    lineMarks({
      toggle: (line) => isScript && toggleBreakpoint(studio, doc, line),
      edit: (line) => isScript && editBreakpoint(studio, doc, line),
    }),
    isScript ? assist(studio, doc, (at) => void goToDefinition(studio, doc, at)) : [],
  ];
  const settings = readSettings(studio.topics.get('studio', {})?.settings);
  return makeState({
    text: shown,
    language: opened.language,
    label: isScript ? text.editor.label(name) : text.editor.textLabel(name),
    extensions,
    settings,
    dark: document.documentElement.dataset['theme'] !== 'light',
    readOnly: !studio.mayEdit,
  });
}

function tellCursor(studio: Studio, doc: Doc, change: ViewUpdate): void {
  if (!change.selectionSet && !change.docChanged && !change.focusChanged) return;
  // Without the keyboard it is told of the text that had it last: a list shows a line there.
  const { cursor } = studio.window.getState();
  if (!change.view.hasFocus && cursor && cursor.doc !== doc) return;
  const { line, column } = placeOf(change.state.doc, change.state.selection.main.head);
  update(studio.window, (draft) => {
    draft.cursor = { doc, line, column };
    if (change.view.hasFocus) draft.doc = doc;
  });
}

/** Tells the editor what `make` makes, now and whenever `make` is another function. */
export function useEffectIn(view: EditorView | null, make: () => StateEffect<unknown>): void {
  useEffect(() => {
    view?.dispatch({ effects: make() });
  }, [view, make]);
}
