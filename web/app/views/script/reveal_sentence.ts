// Keeps what is wrong with the line of the caret in sight: the sentence below it comes after the key,
// and at the lower end of the editor it would be out of sight.

import type { Extension } from '@codemirror/state';
import { EditorView, ViewPlugin, type ViewUpdate } from '@codemirror/view';
import { setFindings } from './findings';

export const revealSentence: Extension = ViewPlugin.fromClass(
  class {
    constructor(view: EditorView) {
      tellWidths(view);
    }

    update(change: ViewUpdate) {
      if (change.geometryChanged) tellWidths(change.view);
      const told = change.transactions.some((one) =>
        one.effects.some((effect) => effect.is(setFindings)),
      );
      if ((told || change.geometryChanged) && change.view.hasFocus) reveal(change.view);
    }
  },
);

function reveal(view: EditorView): void {
  view.requestMeasure({ key: reveal, read: hiddenBelow, write: scrollBy });
}

/** A notice that comes above the text pushes the caret's line out of sight by so much. */
const kPushedMaxPx = 64;

/** How much of the caret's line, with what is below it, is out of sight; 0 if the caret is far away. */
function hiddenBelow(view: EditorView): number {
  const { scrollTop, clientHeight } = view.scrollDOM;
  const line = view.lineBlockAt(view.state.selection.main.head);
  const { top: above } = view.documentPadding;
  const below = line.top + above - scrollTop;
  const isNear = below >= 0 && below < clientHeight + kPushedMaxPx;
  return isNear ? Math.max(0, line.bottom + above - scrollTop - clientHeight) : 0;
}

function scrollBy(hidden: number, view: EditorView): void {
  if (hidden > 0) view.scrollDOM.scrollTop += hidden;
}

/** For the style sheet: how wide the gutters are, and what is seen of the text beside them. */
function tellWidths(view: EditorView): void {
  const key = tellWidths;
  view.requestMeasure({
    key,
    read: () => {
      const gutters = view.scrollDOM.querySelector<HTMLElement>('.cm-gutters')?.offsetWidth ?? 0;
      return { gutters, seen: view.scrollDOM.clientWidth - gutters };
    },
    write: ({ gutters, seen }) => {
      view.dom.style.setProperty('--gutters', `${gutters}px`);
      view.dom.style.setProperty('--seen', `${seen}px`);
    },
  });
}
