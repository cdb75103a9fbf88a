// The editor that shows generated code: read only, with the lines of the chosen element marked.

import { EditorState, RangeSetBuilder, StateEffect, StateField } from '@codemirror/state';
import {
  Decoration,
  EditorView,
  keymap,
  lineNumbers,
  type DecorationSet,
  type ViewUpdate,
} from '@codemirror/view';
import type { CodeMark } from '../../../../protocol/messages';
import { drawWords } from '../words';
import { cppColours } from './cpp_colours';

const setMarks = StateEffect.define<readonly CodeMark[]>();
const line = Decoration.line({ class: 'cm-ofElement' });

const markedLines = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(before, transaction) {
    const effect = transaction.effects.find((one) => one.is(setMarks));
    if (!effect) return before.map(transaction.changes);
    const { doc } = transaction.state;
    const builder = new RangeSetBuilder<Decoration>();
    for (const { first, last } of effect.value)
      for (let number = first; number <= Math.min(last, doc.lines); number++)
        builder.add(doc.line(number).from, doc.line(number).from, line);
    return builder.finish();
  },
  provide: (field) => EditorView.decorations.from(field),
});

/** onLine: a person went to that line. */
export function codeEditor(parent: HTMLElement, onLine: (line: number) => void): EditorView {
  const lineOf = (view: EditorView) => view.state.doc.lineAt(view.state.selection.main.head).number;
  const moved = (update: ViewUpdate) => {
    const isByHand = update.transactions.some((one) => one.isUserEvent('select'));
    if (update.selectionSet && isByHand) onLine(lineOf(update.view));
  };
  return new EditorView({
    parent,
    state: EditorState.create({
      extensions: [
        EditorState.readOnly.of(true),
        lineNumbers(),
        cppColours,
        markedLines,
        keymap.of([
          { key: 'ArrowDown', run: byLine(1) },
          { key: 'ArrowUp', run: byLine(-1) },
        ]),
        EditorView.updateListener.of(moved),
        EditorView.contentAttributes.of({ 'aria-label': drawWords.codeLabel, tabindex: '0' }),
      ],
    }),
  });
}

function byLine(by: number) {
  return (view: EditorView) => {
    const { doc, selection } = view.state;
    const number = doc.lineAt(selection.main.head).number + by;
    if (number < 1 || number > doc.lines) return true;
    view.dispatch({
      selection: { anchor: doc.line(number).from },
      userEvent: 'select',
      scrollIntoView: true,
    });
    return true;
  };
}

export function showCode(view: EditorView, code: string): void {
  const { doc } = view.state;
  if (doc.toString() === code) return;
  view.dispatch({ changes: { from: 0, to: doc.length, insert: code } });
}

/** Marks lines; `reveal` brings the first of them into sight. */
export function showMarks(view: EditorView, marks: readonly CodeMark[], reveal: boolean): void {
  const sorted = [...marks].sort((a, b) => a.first - b.first);
  const first = sorted[0]?.first;
  const { doc } = view.state;
  const at = reveal && first !== undefined && first <= doc.lines ? doc.line(first).from : null;
  view.dispatch({
    effects: [
      setMarks.of(sorted),
      ...(at === null ? [] : [EditorView.scrollIntoView(at, { y: 'center' })]),
    ],
  });
}
