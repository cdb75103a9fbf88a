import { useMemo } from 'react';
import type { Doc, Finding } from '../../../../protocol/messages';
import type { Keys } from '../../../../core/plan/model';
import { findingsAt, findingsOfElement, wantedBy } from '../../../../core/plan/row_findings';
import { pressFix } from '../../../commands/problem_commands';
import { useDrives, useStudio, useTopic } from '../../../hooks';
import { Button } from '../../../parts/button';
import { FindingButton } from '../finding_button';
import '../../../look/palette.css';

/** What is wrong with one member of the file. */
export function useFindingsAt(doc: Doc, keys: Keys): Finding[] {
  const all = useFindings(doc);
  const way = keys.join('\n');
  return useMemo(() => findingsAt(all, way.split('\n')), [all, way]);
}

function useFindings(doc: Doc): Finding[] {
  const all = useTopic('findings', {})?.findings;
  return useMemo(() => (all ?? []).filter((one) => one.doc === doc), [all, doc]);
}

/** What is wrong with an element, where none of its rows is meant. */
export function ElementFindings({ doc, keys }: { doc: Doc; keys: Keys }) {
  const all = useFindings(doc);
  return <Findings findings={findingsOfElement(all, keys)} />;
}

/** The sentences of the checker, each with the button that fixes it. */
export function Findings({ findings, id }: { findings: readonly Finding[]; id?: string }) {
  const studio = useStudio();
  const drives = useDrives();
  if (findings.length === 0) return null;
  return (
    <div className="planform__found" id={id}>
      {findings.map((one) => (
        <div key={`${one.code} ${one.what}`} className={`planform__one is-${one.severity}`}>
          <p>{one.what}</p>
          {one.fixes.map((fix) => (
            <Button
              key={fix.label}
              small
              disabled={!drives}
              onClick={() => pressFix(studio, one, fix)}
            >
              {fix.label}
            </Button>
          ))}
          {one.fixes.length === 0 && wantedBy(one)?.is !== 'formula' ? (
            <FindingButton finding={one} />
          ) : null}
        </div>
      ))}
    </div>
  );
}

export const isWrong = (findings: readonly Finding[]) =>
  findings.some((one) => one.severity === 'error');
