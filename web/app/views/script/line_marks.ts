// What is at lines: words of a handler, breakpoints with their conditions, log points, the line where
// the node is paused, and the values of what that line names.

import {
  RangeSet,
  StateEffect,
  StateField,
  type Extension,
  type Range,
  type Text,
} from '@codemirror/state';
import {
  Decoration,
  EditorView,
  gutter,
  gutterLineClass,
  GutterMarker,
  lineNumbers,
  WidgetType,
  type DecorationSet,
} from '@codemirror/view';

export interface Chip {
  line: number;
  text: string;
}

export interface BreakMark {
  line: number;
  /** log: no breakpoint, but a log point in the run that is shown. */
  kind: 'on' | 'if' | 'off' | 'unset' | 'log';
  label: string;
  /** Said in a chip at the line's end. */
  note: string;
}

export interface Standing {
  line: number;
  values: string;
}

export const setChips = StateEffect.define<readonly Chip[]>();
export const setBreaks = StateEffect.define<readonly BreakMark[]>();
export const setStanding = StateEffect.define<Standing | null>();

const chips = decorations(setChips, (list, doc) =>
  list.flatMap(({ line, text }) =>
    line >= 1 && line <= doc.lines ? [chip(text, doc.line(line).to)] : [],
  ),
);

const breakNotes = decorations(setBreaks, (list, doc) =>
  list.flatMap(({ line, note }) =>
    note && line <= doc.lines ? [chip(note, doc.line(line).to)] : [],
  ),
);

const standing = decorations(setStanding, (here, doc) => {
  if (!here || here.line > doc.lines) return [];
  const line = doc.line(Math.max(1, here.line));
  const marks = [Decoration.line({ class: 'cm-standing' }).range(line.from)];
  const indent = /^\s*/.exec(line.text)?.[0] ?? '';
  if (here.values)
    marks.push(
      Decoration.widget({
        widget: new Words(indent + here.values, 'div', 'cm-values'),
        block: true,
        side: 1,
      }).range(line.to),
    );
  return marks;
});

const standingGutter = StateField.define<RangeSet<GutterMarker>>({
  create: () => RangeSet.empty,
  update(value, transaction) {
    for (const effect of transaction.effects) {
      if (!effect.is(setStanding)) continue;
      const { doc } = transaction.state;
      if (!effect.value || effect.value.line > doc.lines) return RangeSet.empty;
      return RangeSet.of([new StandingMarker().range(doc.line(effect.value.line).from)]);
    }
    return value.map(transaction.changes);
  },
  provide: (self) => gutterLineClass.from(self),
});

const breakMarkers = StateField.define<RangeSet<GutterMarker>>({
  create: () => RangeSet.empty,
  update(value, transaction) {
    for (const effect of transaction.effects) {
      if (!effect.is(setBreaks)) continue;
      const { doc } = transaction.state;
      const seen = effect.value.filter((mark) => mark.line >= 1 && mark.line <= doc.lines);
      return RangeSet.of(
        seen.map((mark) => new Disc(mark).range(doc.line(mark.line).from)),
        true,
      );
    }
    return value.map(transaction.changes);
  },
});

/** toggle: a click or tap on the number of a line, or beside it; edit: with the other button, or a long touch. */
export function lineMarks(act: {
  toggle(line: number): void;
  edit(line: number): void;
}): Extension {
  const lineAt = (view: EditorView, { from }: { from: number }) =>
    view.state.doc.lineAt(from).number;
  const domEventHandlers = {
    mousedown(view: EditorView, block: { from: number }, event: Event) {
      const mouse = event as MouseEvent;
      if (mouse.button === 0 && !mouse.altKey) act.toggle(lineAt(view, block));
      else act.edit(lineAt(view, block));
      return true;
    },
    contextmenu(view: EditorView, block: { from: number }, event: Event) {
      event.preventDefault();
      // A mouse has said so with its button; a finger that stays says it here alone.
      if ((event as PointerEvent).pointerType === 'touch') act.edit(lineAt(view, block));
      return true;
    },
  };
  return [
    breakMarkers,
    gutter({
      class: 'cm-breaks',
      markers: (view) => view.state.field(breakMarkers),
      initialSpacer: () => new Disc({ line: 0, kind: 'on', label: '', note: '' }),
      domEventHandlers,
    }),
    lineNumbers({ domEventHandlers }),
    chips,
    breakNotes,
    standing,
    standingGutter,
  ];
}

/** A field of decorations that are made again by an effect, and move with the text meanwhile. */
function decorations<T>(
  set: ReturnType<typeof StateEffect.define<T>>,
  make: (value: T, doc: Text) => Range<Decoration>[],
): Extension {
  return StateField.define<DecorationSet>({
    create: () => Decoration.none,
    update(value, transaction) {
      for (const effect of transaction.effects)
        if (effect.is(set)) return Decoration.set(make(effect.value, transaction.state.doc), true);
      return value.map(transaction.changes);
    },
    provide: (self) => EditorView.decorations.from(self),
  });
}

function chip(text: string, at: number): Range<Decoration> {
  return Decoration.widget({ widget: new Words(text, 'span', 'chip'), side: 1 }).range(at);
}

/** Words that are in the text and are none of it. */
class Words extends WidgetType {
  constructor(
    private readonly text: string,
    private readonly tag: 'span' | 'div',
    private readonly look: string,
  ) {
    super();
  }
  override eq(other: Words): boolean {
    return other.text === this.text && other.look === this.look;
  }
  override toDOM(): HTMLElement {
    const element = document.createElement(this.tag);
    element.className = this.look;
    element.textContent = this.text;
    return element;
  }
}

class Disc extends GutterMarker {
  constructor(private readonly mark: BreakMark) {
    super();
  }
  override eq(other: Disc): boolean {
    return other.mark.kind === this.mark.kind && other.mark.label === this.mark.label;
  }
  override toDOM(): HTMLElement {
    const disc = document.createElement('span');
    disc.className = `disc disc--${this.mark.kind}`;
    disc.title = this.mark.label;
    return disc;
  }
}

class StandingMarker extends GutterMarker {
  override elementClass = 'cm-standingGutter';
}
