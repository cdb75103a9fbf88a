// The editors that are shown, by document.

import type { EditorView } from '@codemirror/view';
import type { Doc } from '../../../protocol/messages';
import type { Studio } from '../../../core/studio';

const views = new WeakMap<Studio, Map<Doc, EditorView>>();

export function showView(studio: Studio, doc: Doc, view: EditorView): () => void {
  const own = views.get(studio) ?? new Map<Doc, EditorView>();
  views.set(studio, own);
  own.set(doc, view);
  return () => void (own.get(doc) === view && own.delete(doc));
}

export function shownView(studio: Studio, doc: Doc): EditorView | undefined {
  return views.get(studio)?.get(doc);
}
