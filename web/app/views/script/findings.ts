// Findings in the text: what is meant is underlined, and an error's sentence is in a block below
// its line, with its fix as a button: once the caret has left the line, or has typed nothing for half a second.

import {
  RangeSet,
  StateEffect,
  StateField,
  type EditorState,
  type Extension,
  type Range,
  type Text,
  type Transaction,
} from '@codemirror/state';
import {
  Decoration,
  EditorView,
  ViewPlugin,
  WidgetType,
  type DecorationSet,
  type ViewUpdate,
} from '@codemirror/view';
import type { Finding, Fix } from '../../../protocol/messages';
import { mistakeInLine } from '../../../core/plan/formula_place';
import { offsetOf } from './places';
import { keysShown } from '../../parts/keys_shown';

export interface FindingsShown {
  findings: readonly Finding[];
  onFix(finding: Finding, fix: Fix): void;
}

export const setFindings = StateEffect.define<FindingsShown>();

/** Nobody has typed for a moment. */
const settle = StateEffect.define<null>();
export const kSettledMs = 500;

interface FieldValue {
  marks: DecorationSet;
  blocks: DecorationSet;
  findings: readonly Finding[];
  /** What was told last, as long as it is about the text as it is. */
  told: FindingsShown | null;
  /** Somebody types: sentences below the caret's line neither come nor go, so that the text does not jump. */
  types: boolean;
}

const nothing: FieldValue = {
  marks: Decoration.none,
  blocks: Decoration.none,
  findings: [],
  told: null,
  types: false,
};

const field = StateField.define<FieldValue>({
  create: () => nothing,
  update(before, transaction) {
    const { state } = transaction;
    const told = transaction.effects.find((effect) => effect.is(setFindings))?.value;
    const typed = transaction.isUserEvent('input') || transaction.isUserEvent('delete');
    const settled =
      transaction.effects.some((effect) => effect.is(settle)) || leavesLine(transaction);
    const types = typed || (before.types && !settled);
    const mapped = transaction.docChanged
      ? {
          ...before,
          told: null,
          marks: before.marks.map(transaction.changes),
          blocks: before.blocks.map(transaction.changes),
        }
      : before;
    const news = told ?? (before.types && !types ? mapped.told : null);
    if (!news) return types === before.types && mapped === before ? before : { ...mapped, types };
    const next = { ...shown(news, state.doc), told: news, types };
    return types ? { ...next, blocks: heldAtCaret(state, mapped.blocks, next.blocks) } : next;
  },
  provide: (self) => [
    EditorView.decorations.from(self, (value) => value.marks),
    EditorView.decorations.from(self, (value) => value.blocks),
  ],
});

function leavesLine({ startState, state, docChanged, selection }: Transaction): boolean {
  const line = (of: EditorState) => of.doc.lineAt(of.selection.main.head).number;
  return !docChanged && selection !== undefined && line(startState) !== line(state);
}

/** New sentences, but at the caret's line those that were there. */
function heldAtCaret(state: EditorState, old: DecorationSet, news: DecorationSet): DecorationSet {
  const { from, to } = state.doc.lineAt(state.selection.main.head);
  const isAtCaret = (at: number) => at >= from && at <= to;
  const held: Range<Decoration>[] = [];
  old.between(from, to, (at, _to, block) => {
    if (isAtCaret(at)) held.push(block.range(at));
  });
  return news.update({ filter: (at) => !isAtCaret(at), add: held, sort: true });
}

const settling = ViewPlugin.define((view) => {
  let timer: ReturnType<typeof setTimeout> | undefined;
  return {
    update(update: ViewUpdate) {
      if (!update.state.field(field).types) return clearTimeout(timer);
      if (!update.docChanged) return;
      clearTimeout(timer);
      timer = setTimeout(() => view.dispatch({ effects: settle.of(null) }), kSettledMs);
    },
    destroy: () => clearTimeout(timer),
  };
});

export const findingsExtension: Extension = [field, settling];

/** Numbers of the lines below which a sentence is. */
export function linesWithSentence(state: EditorState): number[] {
  const found: number[] = [];
  state.field(field).blocks.between(0, state.doc.length, (at) => {
    found.push(state.doc.lineAt(at).number);
  });
  return found;
}

/** The findings at an offset, for the help under the pointer. */
export function findingsAt(state: EditorState, offset: number): Finding[] {
  const { marks, findings } = state.field(field);
  const found: Finding[] = [];
  marks.between(offset, offset, (_from, _to, mark) => {
    const finding = findings[Number((mark.spec as { index: number }).index)];
    if (finding) found.push(finding);
  });
  return found;
}

function shown(
  { findings, onFix }: FindingsShown,
  doc: Text,
): Pick<FieldValue, 'marks' | 'blocks' | 'findings'> {
  const marks: Range<Decoration>[] = [];
  const blocks = new Map<number, Range<Decoration>>();
  findings.forEach((finding, index) => {
    const [from, to] = rangeOf(finding, doc);
    const kind = finding.severity;
    // A text without a character has nothing to mark.
    if (to > from)
      marks.push(
        Decoration.mark({ class: `cm-finding cm-finding--${kind}`, index }).range(from, to),
      );
    const end = doc.lineAt(to).to;
    if (kind === 'error' && !blocks.has(end))
      blocks.set(
        end,
        Decoration.widget({ widget: new Sentence(finding, onFix), block: true, side: 1 }).range(
          end,
        ),
      );
  });
  return {
    marks: RangeSet.of(marks, true),
    blocks: RangeSet.of([...blocks.values()], true),
    findings,
  };
}

/** At least one character, so that there is something to see: the one behind, else the one before. */
function rangeOf(finding: Finding, doc: Text): [number, number] {
  const from = offsetOf(doc, finding.at);
  const line = doc.lineAt(from);
  const inside = finding.keys && mistakeInLine(line.text, from - line.from, finding.what);
  if (inside) return [line.from + inside.from, line.from + inside.to];
  const to = Math.max(offsetOf(doc, finding.end), from);
  if (to > from) return [from, to];
  return from < doc.lineAt(from).to ? [from, from + 1] : [Math.max(0, from - 1), from];
}

class Sentence extends WidgetType {
  constructor(
    private readonly finding: Finding,
    private readonly onFix: FindingsShown['onFix'],
  ) {
    super();
  }

  override eq(other: Sentence): boolean {
    const { what, fixes } = this.finding;
    return (
      other.finding.what === what && JSON.stringify(other.finding.fixes) === JSON.stringify(fixes)
    );
  }

  override toDOM(): HTMLElement {
    const frame = document.createElement('div');
    // Space around it is padding: the editor does not see margins.
    frame.className = 'diag-frame';
    const block = document.createElement('div');
    block.className = 'diag';
    block.setAttribute('role', 'note');
    block.innerHTML = octagon;
    const sentence = document.createElement('span');
    sentence.className = 'diag__what';
    sentence.textContent = this.finding.what;
    block.append(sentence);
    this.finding.fixes
      .slice(0, 3)
      .forEach((fix, index) => block.append(this.button(fix, index === 0)));
    frame.append(block);
    return frame;
  }

  private button(fix: Fix, first: boolean): HTMLElement {
    const button = document.createElement('button');
    button.type = 'button';
    button.className = 'btn btn--small';
    button.textContent = fix.label;
    if (first) {
      const keys = document.createElement('span');
      keys.className = 'kbd';
      keys.textContent = keysShown('Alt+Enter');
      button.append(keys);
    }
    button.onclick = () => this.onFix(this.finding, fix);
    return button;
  }

  override ignoreEvent(): boolean {
    return true;
  }
}

const octagon =
  '<svg class="icon is-error" width="16" height="16" viewBox="0 0 24 24" fill="none" stroke="currentColor" stroke-width="1.75" stroke-linecap="round" stroke-linejoin="round" aria-hidden="true"><path d="M12.802 2.165l5.575 2.389c.48 .206 .863 .589 1.07 1.07l2.388 5.574c.22 .512 .22 1.092 0 1.604l-2.389 5.575c-.206 .48 -.589 .863 -1.07 1.07l-5.574 2.388c-.512 .22 -1.092 .22 -1.604 0l-5.575 -2.389a2.036 2.036 0 0 1 -1.07 -1.07l-2.388 -5.574a2.036 2.036 0 0 1 0 -1.604l2.389 -5.575c.206 -.48 .589 -.863 1.07 -1.07l5.574 -2.388a2.036 2.036 0 0 1 1.604 0z"/><path d="M12 8v4"/><path d="M12 16h.01"/></svg>';
