import { IconAlertOctagon, IconAlertTriangle } from '@tabler/icons-react';
import { useRef } from 'react';
import type { Finding } from '../../protocol/messages';
import { ordered } from '../../core/findings';
import { pressFix, showProblem } from '../commands/problem_commands';
import { nameOf } from '../dock/documents';
import { useDrives, useStudio, useTopic, useWindow } from '../hooks';
import { Quiet } from '../parts/blank';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { text } from '../text';
import '../look/lists.css';

/** All mistakes and remarks of the project, errors first. */
export default function ProblemsPanel() {
  const studio = useStudio();
  const topic = useTopic('findings', {});
  const current = useWindow((state) => state.problem);
  const cursor = useWindow((state) => state.cursor);
  const isHere = (finding: Finding) =>
    finding.doc === cursor?.doc &&
    cursor.line >= finding.at.line &&
    cursor.line <= finding.end.line;
  const list = useRef<HTMLUListElement>(null);
  const findings = ordered(topic?.findings ?? []);
  const focus = (index: number) =>
    list.current?.querySelectorAll<HTMLElement>('.problem__open')[index]?.focus();
  if (findings.length === 0) return <Quiet>{text.empty.problems}</Quiet>;
  return (
    <ul
      className="scroll problems"
      aria-label={text.problems.label}
      ref={list}
      onKeyDown={(event) => {
        const now = [...(list.current?.querySelectorAll('.problem__open') ?? [])].indexOf(
          event.target as Element,
        );
        const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
        if (now < 0 || !by) return;
        event.preventDefault();
        focus(now + by);
      }}
    >
      {findings.map((finding, index) => (
        <Problem
          key={`${finding.doc} ${finding.at.line} ${finding.at.column} ${finding.code} ${index}`}
          finding={finding}
          chosen={index === current || isHere(finding)}
          onOpen={() => showProblem(studio, index)}
        />
      ))}
      {topic && topic.more > 0 ? <Quiet>{text.problems.more(topic.more)}</Quiet> : null}
    </ul>
  );
}

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
    <li className={chosen ? 'problem is-on' : 'problem'}>
      <button
        type="button"
        className="problem__open"
        data-inset
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
        <span className="problem__code">{element ? `${place} · ${code}` : code}</span>
      </button>
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
    </li>
  );
}
