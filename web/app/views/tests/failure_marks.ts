// What was not as expected, at its line of a test: the line is marked, and a sentence is below it, as
// below any mistake.

import { StateEffect, StateField, type Range, type Text } from '@codemirror/state';
import { Decoration, EditorView, WidgetType, type DecorationSet } from '@codemirror/view';
import type { Marks } from './use_marks';

export interface FailureMark {
  line: number;
  text: string;
}

const setFailures = StateEffect.define<readonly FailureMark[]>();

const field = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(value, transaction) {
    for (const effect of transaction.effects)
      if (effect.is(setFailures))
        return Decoration.set(
          effect.value.flatMap((one) => marked(one, transaction.state.doc)),
          true,
        );
    return value.map(transaction.changes);
  },
  provide: (self) => EditorView.decorations.from(self),
});

export const failureMarks: Marks<FailureMark> = {
  field,
  extension: field,
  set: (marks) => setFailures.of(marks),
};

function marked({ line, text }: FailureMark, doc: Text): Range<Decoration>[] {
  if (line < 1 || line > doc.lines) return [];
  const { from, to } = doc.line(line);
  return [
    Decoration.line({ class: 'cm-failed' }).range(from),
    Decoration.widget({ widget: new Sentence(text), block: true, side: 1 }).range(to),
  ];
}

class Sentence extends WidgetType {
  constructor(private readonly text: string) {
    super();
  }

  override eq(other: Sentence): boolean {
    return other.text === this.text;
  }

  override toDOM(): HTMLElement {
    const frame = document.createElement('div');
    frame.className = 'diag-frame';
    const block = document.createElement('div');
    block.className = 'diag';
    block.setAttribute('role', 'note');
    const sentence = document.createElement('span');
    sentence.className = 'diag__what';
    sentence.textContent = `✕ ${this.text}`;
    block.append(sentence);
    frame.append(block);
    return frame;
  }
}
