// What commands can ask of an open editor, without knowing how it is made.

import type { Doc } from '../../protocol/messages';
import type { Studio } from '../../core/studio';

export interface EditorHandle {
  toggleBreakpoint(): void;
  editBreakpoint(): void;
  definition(): void;
  references(): void;
  rename(): void;
  complete(): void;
  find(): void;
  comment(): void;
  undo(): void;
  redo(): void;
  mayUndo(): boolean;
  mayRedo(): boolean;
  focus(): void;
  /** Where the caret is, while the editor has the focus; '' if there is none. */
  word(): string;
  /** Where the caret is, from 1. */
  line(): number;
}

const handles = new WeakMap<Studio, Map<Doc, EditorHandle>>();

/** Tells of an editor until the returned function is called. */
export function addEditor(studio: Studio, doc: Doc, handle: EditorHandle): () => void {
  const own = handles.get(studio) ?? new Map<Doc, EditorHandle>();
  handles.set(studio, own);
  own.set(doc, handle);
  return () => void (own.get(doc) === handle && own.delete(doc));
}

/** The editor of the document that is looked at. */
export function shownEditor(studio: Studio): EditorHandle | undefined {
  const { doc } = studio.window.getState();
  return doc === null ? undefined : handles.get(studio)?.get(doc);
}
