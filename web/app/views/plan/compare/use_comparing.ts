import { useEffect, useMemo } from 'react';
import type { Doc } from '../../../../protocol/messages';
import type { PlanBoard } from '../../../../core/plan/board';
import { comparingOf, type Compared, type Comparing } from '../../../../core/plan/comparing';
import { ghostsOf, type Ghosts } from '../../../../core/plan/ghosts';
import { planModel } from '../../../../core/plan/model';
import { useChanges, usePart, useStudio, useTopic } from '../../../hooks';

/** The comparison of the window, if it is about this document. */
export function useComparing(doc: Doc): Comparing | null {
  const comparing = comparingOf(useStudio());
  useChanges(comparing.changed);
  return comparing.doc === doc ? comparing : null;
}

/** Compares again when the text, the file, or what runs is another one. */
export function useCompared(comparing: Comparing, doc: Doc): void {
  const version = usePart('doc', { doc }, (is) => is?.version);
  const disk = usePart('doc', { doc }, (is) => is?.disk_hash);
  const taken = usePart('plan', {}, (is) => `${is?.state} ${is?.change?.number}`);
  useEffect(() => void comparing.ask(), [comparing, version, disk, taken]);
}

const kWaysMs = 100; // for the ways of arrows as they were

/** What is no more, placed in the drawing. */
export function useGhosts(board: PlanBoard, { before, differences }: Compared): Ghosts {
  const toolboxes = useTopic('templates', {})?.toolboxes;
  const { model } = board;
  // Not while something is dragged: where elements are, in the file, is in the model.
  return useMemo(() => {
    const end = performance.now() + kWaysMs;
    const was = planModel(before, toolboxes ?? []);
    const now = { model, scene: board.scene };
    return ghostsOf(differences, was, now, () => performance.now() > end);
  }, [before, differences, toolboxes, model, board]);
}
