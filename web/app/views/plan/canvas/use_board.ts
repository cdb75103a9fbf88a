// The board of a document: its file open for edits, followed by what the server says.

import { useEffect, useMemo } from 'react';
import type { Doc, PlanTemplate } from '../../../../protocol/messages';
import { PlanBoard } from '../../../../core/plan/board';
import type { JsonFile } from '../../../../core/session/json_file';
import { subPlanDoc, subPlanTemplate } from '../../../../core/plan/sub_plans';
import type { Studio } from '../../../../core/studio';
import { useStudio, useTopic } from '../../../hooks';
import { useJsonFile } from '../../world/use_world';

export function usePlanBoard(doc: Doc): { board: PlanBoard | null; failed: string | null } {
  const studio = useStudio();
  const { file, failed } = useJsonFile(doc);
  const toolboxes = useTopic('templates', {})?.toolboxes;
  const made = useMemo(
    () => file && { board: new PlanBoard(doc, file, [], turns), changes: file.changed.count },
    [doc, file],
  );
  const board = made?.board ?? null;
  useEffect(() => {
    if (!made) return;
    const { board, changes } = made;
    // Between drawing and now somebody may have typed.
    if (board.file.changed.count !== changes) board.refresh();
    return board.file.changed.on(() => board.refresh());
  }, [made]);
  useEffect(() => {
    if (toolboxes) board?.refresh(toolboxes);
  }, [board, toolboxes]);
  useEffect(() => (board ? followSubPlans(studio, board) : undefined), [studio, board]);
  return { board, failed };
}

const turns = {
  now: () => performance.now(),
  later: (act: () => void) => void setTimeout(act),
};

/** Keeps what the board knows of its sub-plans as their files are, saved or not. */
function followSubPlans(studio: Studio, board: PlanBoard): () => void {
  const known = new Map<string, PlanTemplate>();
  const ends = new Map<string, () => void>();
  const take = (path: string, file: JsonFile) => {
    // The checker says what is wrong with it.
    if (file.broken !== null) return;
    known.set(path, subPlanTemplate(path, file.value));
    board.refresh(undefined, new Map(known));
  };
  const look = () => {
    for (const path of pathsOf(board))
      if (!ends.has(path))
        ends.set(
          path,
          follow(studio, subPlanDoc(board.doc, path), (file) => take(path, file)),
        );
  };
  const end = board.changed.on(look);
  look();
  return () => {
    end();
    ends.forEach((one) => one());
  };
}

/** Calls `take` with a file at first and whenever it is another one. */
function follow(studio: Studio, doc: Doc, take: (file: JsonFile) => void): () => void {
  let end: (() => void) | null = null;
  let gone = false;
  const held = studio.documents.acquire(doc);
  held.opened.then(
    (opened) => {
      if (gone) return;
      const file = opened.file();
      end = file.changed.on(() => take(file));
      take(file);
    },
    // The checker says that it is missing.
    () => {},
  );
  return () => {
    gone = true;
    end?.();
    held.release();
  };
}

function pathsOf({ model }: PlanBoard): string[] {
  return model.actors.flatMap((one) => (one.role === 'subplan' ? one.template : []));
}
