import type { EditorView } from '@codemirror/view';
import { useEffect, useRef, useState } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import { elementAt, marksOf } from '../../../../core/plan/code';
import { useStudio } from '../../../hooks';
import { drawWords as words } from '../words';
import { Findings } from '../form/row_findings';
import { useBoard, usePlanDesk } from '../plan_desk';
import { codeEditor, showCode, showMarks } from './code_editor';
import { usePlanCode, type PlanCode } from './use_code';
import '../../../look/editor.css';

/** The C++ program of a plan: what is chosen on the drawing is marked in it, and the other way round. */
export default function PlanCodeView({ doc }: { doc: string }) {
  const { shown } = usePlanDesk(useStudio());
  return shown?.board.doc === doc ? <Code key={doc} board={shown.board} /> : null;
}

function Code({ board }: { board: PlanBoard }) {
  const code = usePlanCode(board);
  const errors = code?.findings ?? [];
  return (
    <section className="plancode" aria-label={words.code}>
      <header className="plancode__head">
        <span className="ellipsis">{code?.name || words.code}</span>
        <span className="muted ellipsis">{words.codeHelp}</span>
      </header>
      {errors.length > 0 ? (
        <div className="plancode__errors" role="status">
          <p>{words.noCode}</p>
          <Findings findings={errors} />
        </div>
      ) : null}
      <Lines board={board} code={code} />
    </section>
  );
}

function Lines({ board, code }: { board: PlanBoard; code: PlanCode | null }) {
  useBoard(board);
  const host = useRef<HTMLDivElement>(null);
  const [view, setView] = useState<EditorView | null>(null);
  const latest = useRef(code);
  // The element that was chosen by its line: the line stays where it is.
  const byLine = useRef<string | null>(null);
  const key = board.arrow(board.selected)?.source ?? board.selected;
  useEffect(() => {
    if (!host.current) return;
    const made = codeEditor(host.current, (line) => {
      const element = elementAt(latest.current?.marks ?? [], line);
      byLine.current = element;
      if (element !== null) board.select(element);
    });
    setView(made);
    return () => made.destroy();
  }, [board]);
  useEffect(() => {
    latest.current = code;
    if (!view || !code) return;
    showCode(view, code.text);
    showMarks(view, marksOf(code.marks, key), byLine.current !== key);
    byLine.current = null;
  }, [view, code, key]);
  return <div className="plancode__text" ref={host} hidden={(code?.findings.length ?? 0) > 0} />;
}
