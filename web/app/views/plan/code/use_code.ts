// The generated code of a plan, asked for again a moment after each edit.

import { useEffect, useState } from 'react';
import type { Commands } from '../../../../protocol/messages';
import type { PlanBoard } from '../../../../core/plan/board';
import { useChanges, useStudio, useTopic } from '../../../hooks';

export type PlanCode = Commands['plan.code']['out'];

const kPauseMs = 250;

export function usePlanCode(board: PlanBoard): PlanCode | null {
  const studio = useStudio();
  const edits = useChanges(board.file.changed);
  // Templates are others when a toolbox is edited.
  const toolboxes = useTopic('templates', {})?.toolboxes;
  const [code, setCode] = useState<PlanCode | null>(null);
  useEffect(() => {
    let isLate = false;
    const ask = async () => {
      await studio.documents.sent(board.doc);
      const answer = await studio.send('plan.code', { doc: board.doc });
      if (!isLate) setCode(answer);
    };
    const cancel = studio.world.later(kPauseMs, () => {
      ask().catch((problem: unknown) => isLate || studio.tell(problem));
    });
    return () => {
      isLate = true;
      cancel();
    };
  }, [studio, board, edits, toolboxes]);
  return code;
}
