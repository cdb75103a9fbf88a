import type { EditorView } from '@codemirror/view';
import { linesNamed } from '../../../core/lines_named';
import { testOptionsOf } from '../../../core/tests';
import type { Doc, LineCoverage } from '../../../protocol/messages';
import { useChanges, useStudio, useTopic } from '../../hooks';
import { CoverageSwitch } from './coverage_switch';
import { coverageGutter } from './coverage_gutter';
import { useMarks } from './use_marks';
import { coverageWords as words } from './words';

const kNone: readonly LineCoverage[] = [];

/** Of a script whose lines were counted: the switch, how much was taken, and which lines never were. */
export function ScriptCoverage({ doc, view }: { doc: Doc; view: EditorView | null }) {
  const options = testOptionsOf(useStudio());
  useChanges(options.changed);
  const coverage = useTopic('coverage', { doc });
  const lines = coverage?.lines ?? kNone;
  const isShown = options.coverage && coverage?.changed === false;
  useMarks(view, coverageGutter, isShown ? lines : kNone);
  if (lines.length === 0) return null;
  const never = lines.filter(({ count }) => count === 0).map(({ line }) => line);
  return (
    <div className="tests__bar" role="group" aria-label={words.strip}>
      <CoverageSwitch />
      {options.coverage ? (
        <span className="tests__lines">
          {coverage?.changed
            ? words.changed
            : words.lines(lines.length - never.length, lines.length, linesNamed(never))}
        </span>
      ) : null}
    </div>
  );
}
