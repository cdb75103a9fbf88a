// The board of a document: its file open for edits, followed by what the server says.

import { useEffect, useState } from 'react';
import type { Doc } from '../../../../protocol/messages';
import { PlanBoard } from '../../../../core/plan/board';
import { useTopic } from '../../../hooks';
import { useJsonDocument } from '../../world/use_world';

export function usePlanBoard(doc: Doc): { board: PlanBoard | null; failed: string | null } {
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
  return { board, failed };
}
