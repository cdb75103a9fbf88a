import { StateEffect, type Extension, type StateField } from '@codemirror/state';
import type { EditorView } from '@codemirror/view';
import { useEffect } from 'react';

/** What marks lines, and how an editor is told them. */
export interface Marks<Mark> {
  field: StateField<unknown>;
  extension: Extension;
  set(marks: readonly Mark[]): StateEffect<unknown>;
}

/** Marks lines of an editor that was made without them: its state outlives this component. */
export function useMarks<Mark>(
  view: EditorView | null,
  marks: Marks<Mark>,
  shown: readonly Mark[],
): void {
  useEffect(() => {
    if (!view) return;
    if (view.state.field(marks.field, false) === undefined)
      view.dispatch({ effects: StateEffect.appendConfig.of(marks.extension) });
    view.dispatch({ effects: marks.set(shown) });
  }, [view, marks, shown]);
}
