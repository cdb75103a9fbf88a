import { IconAlertOctagon, IconAlertTriangle } from '@tabler/icons-react';
import type { Finding } from '../../protocol/messages';
import { ordered } from '../../core/findings';
import { fixProblem, pressFix, showProblem } from '../commands/problem_commands';
import { nameOf } from '../documents';
import { useDrives, useStudio, useTopic, useWindow } from '../hooks';
import { Quiet } from '../parts/blank';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { VirtualRows } from '../parts/virtual_rows';
import { text } from '../text';
import { FindingButton } from '../views/plan/finding_button';
import '../look/lists.css';

/** All mistakes and remarks of the project, errors first. */
export default function ProblemsPanel() {
  const studio = useStudio();
  const drives = useDrives();
  const topic = useTopic('findings', {});
  const current = useWindow((state) => state.problem);
  const cursor = useWindow((state) => state.cursor);
  const isHere = (finding: Finding) =>
    finding.doc === cursor?.doc &&
    cursor.line >= finding.at.line &&
    cursor.line <= finding.end.line;
  const findings = ordered(topic?.findings ?? []);
  if (findings.length === 0) return <Quiet>{text.empty.problems}</Quiet>;
  const rows = findings.map((finding, index) => ({ finding, index }));
  return (
    <div className="problems">
      <VirtualRows
        rows={rows}
        label={text.problems.label}
        height={kRowHeight}
        keyOf={({ finding: { doc, at, code }, index }) =>
          `${doc} ${at.line} ${at.column} ${code} ${index}`
        }
        onRowKey={({ finding, index }, event) => {
          if (event.key !== 'Enter' && event.key !== ' ') return;
          if (event.altKey && !drives) return; // the command says why
          event.preventDefault();
          if (event.altKey) fixProblem(studio, finding);
          else showProblem(studio, index);
        }}
      >
        {({ finding, index }) => (
          <Problem
            finding={finding}
            chosen={index === current || isHere(finding)}
            onOpen={() => showProblem(studio, index)}
          />
        )}
      </VirtualRows>
      {topic && topic.more > 0 ? <Quiet>{text.problems.more(topic.more)}</Quiet> : null}
    </div>
  );
}

const kRowHeight = 28;

function Problem({
  finding,
  chosen,
  onOpen,
}: {
  finding: Finding;
  chosen: boolean;
  onOpen(): void;
}) {
  const studio = useStudio();
  const drives = useDrives();
  const { doc, severity, code, element, at, what, fixes } = finding;
  const Icon = severity === 'error' ? IconAlertOctagon : IconAlertTriangle;
  const place = `${nameOf(studio, doc)}:${at.line}:${at.column}`;
  return (
    <div className={chosen ? 'problem is-on' : 'problem'}>
      <button
        type="button"
        className="problem__open"
        data-inset
        // The name of the rule, where one asks for it.
        title={`${place}: ${what} [${code}]`}
        // Keys are those of its row.
        tabIndex={-1}
        aria-current={chosen}
        onClick={onOpen}
      >
        <Icon
          className={`icon is-${severity}`}
          size={16}
          stroke={kStroke}
          role="img"
          aria-label={severity}
        />
        <span className="ellipsis">
          <b>{element ?? place}</b> {what}
        </span>
        {element ? <span className="problem__place">{place}</span> : null}
      </button>
      {fixes.length === 0 ? <FindingButton finding={finding} /> : null}
      {fixes.slice(0, 2).map((fix) => (
        <Button
          key={fix.label}
          small
          disabled={!drives}
          onClick={() => pressFix(studio, finding, fix)}
        >
          {fix.label}
        </Button>
      ))}
    </div>
  );
}
