// The board of a document: its file open for edits, followed by what the server says.

import { useEffect, useState } from 'react';
import type { Doc, PlanTemplate } from '../../../../protocol/messages';
import { PlanBoard } from '../../../../core/plan/board';
import { subPlanDoc, subPlanTemplate } from '../../../../core/plan/sub_plans';
import type { Studio } from '../../../../core/studio';
import { useStudio, useTopic } from '../../../hooks';
import { useJsonDocument } from '../../world/use_world';

export function usePlanBoard(doc: Doc): { board: PlanBoard | null; failed: string | null } {
  const studio = useStudio();
  const { file, failed } = useJsonDocument(doc);
  const toolboxes = useTopic('templates', {})?.toolboxes;
  const [board, setBoard] = useState<PlanBoard | null>(null);
  useEffect(() => {
    if (!file) return;
    const made = new PlanBoard(doc, file, []);
    setBoard(made);
    const end = file.changed.on(() => made.refresh());
    return () => {
      end();
      setBoard(null);
    };
  }, [doc, file]);
  useEffect(() => {
    if (toolboxes) board?.refresh(toolboxes);
  }, [board, toolboxes]);
  useEffect(() => (board ? followSubPlans(studio, board) : undefined), [studio, board]);
  return { board, failed };
}

/** Keeps what the board knows of its sub-plans as their files are, saved or not. */
function followSubPlans(studio: Studio, board: PlanBoard): () => void {
  const known = new Map<string, PlanTemplate>();
  const ends = new Map<string, () => void>();
  const look = () => {
    for (const path of pathsOf(board)) {
      if (ends.has(path)) continue;
      const of = { doc: subPlanDoc(board.doc, path) };
      const take = () => {
        const text = studio.topics.get('doc', of)?.text;
        const file = text === undefined ? undefined : parsed(text);
        if (file === undefined) return;
        known.set(path, subPlanTemplate(path, file));
        board.refresh(undefined, new Map(known));
      };
      ends.set(path, () => {});
      ends.set(path, studio.topics.subscribe('doc', of, take));
      take();
    }
  };
  const end = board.changed.on(look);
  look();
  return () => {
    end();
    ends.forEach((one) => one());
  };
}

function pathsOf({ model }: PlanBoard): string[] {
  return model.actors.flatMap((one) => (one.role === 'subplan' ? one.template : []));
}

function parsed(text: string) {
  try {
    return JSON.parse(text) as Parameters<typeof subPlanTemplate>[1];
  } catch {
    // The checker says what is wrong with it.
    return undefined;
  }
}
