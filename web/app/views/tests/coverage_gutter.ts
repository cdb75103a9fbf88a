// Beside each line that is code: how often the tests executed it, or that they never did.

import { RangeSet, StateEffect, StateField } from '@codemirror/state';
import { gutter, GutterMarker } from '@codemirror/view';
import type { LineCoverage } from '../../../protocol/messages';
import type { Marks } from './use_marks';
import { coverageWords as words, shortOf } from './words';

const setCoverage = StateEffect.define<readonly LineCoverage[]>();

const field = StateField.define<RangeSet<GutterMarker>>({
  create: () => RangeSet.empty,
  update(value, transaction) {
    for (const effect of transaction.effects) {
      if (!effect.is(setCoverage)) continue;
      const { doc } = transaction.state;
      const seen = effect.value.filter(({ line }) => line <= doc.lines);
      return RangeSet.of(
        seen.map((one) => new Count(one).range(doc.line(one.line).from)),
        true,
      );
    }
    return value.map(transaction.changes);
  },
});

export const coverageGutter: Marks<LineCoverage> = {
  field,
  set: (lines) => setCoverage.of(lines),
  extension: [field, gutter({ class: 'cm-coverage', markers: (view) => view.state.field(field) })],
};

class Count extends GutterMarker {
  constructor(private readonly line: LineCoverage) {
    super();
  }

  override eq(other: Count): boolean {
    const { count, ways, taken } = other.line;
    return this.line.count === count && this.line.ways === ways && this.line.taken === taken;
  }

  override toDOM(): HTMLElement {
    const { count, ways, taken } = this.line;
    const isPart = count > 0 && ways !== undefined && (taken ?? 0) < ways;
    const mark = document.createElement('span');
    mark.className = `covered ${count === 0 ? 'is-never' : isPart ? 'is-part' : 'is-taken'}`;
    // Not told by colour alone: a number, a cross, a half circle.
    mark.textContent = count === 0 ? '✕' : `${shortOf(count)}${isPart ? ' ◐' : ''}`;
    mark.title = words.line(count, ways, taken);
    return mark;
  }
}
