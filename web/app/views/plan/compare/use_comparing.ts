import { useEffect, useMemo } from 'react';
import type { Doc, Topics } from '../../../../protocol/messages';
import type { PlanBoard } from '../../../../core/plan/board';
import { comparingOf, type Compared, type Comparing } from '../../../../core/plan/comparing';
import { ghostsOf, type Ghosts } from '../../../../core/plan/ghosts';
import { planModel, type PlanModel } from '../../../../core/plan/model';
import type { Toolboxes } from '../../../../core/plan/templates';
import { useChanges, usePart, useStudio, useTopic } from '../../../hooks';

/** The comparison of the window, if it is about this document. */
export function useComparing(doc: Doc): Comparing | null {
  const comparing = comparingOf(useStudio());
  useChanges(comparing.changed);
  return comparing.doc === doc ? comparing : null;
}

/** Compares again when the text, the file, the other plan, or what runs is another one. */
export function useCompared(comparing: Comparing, doc: Doc): void {
  const file = comparing.other?.file;
  const own = usePart('doc', { doc }, versionOf);
  const other = usePart('doc', file === undefined ? null : { doc: file }, versionOf);
  const taken = usePart('plan', {}, (is) => `${is?.state} ${is?.change?.number}`);
  useEffect(() => void comparing.ask(), [comparing, own, other, taken]);
}

/** Of the text, and of what is on disk: a text that was saved is what the file has. */
const versionOf = (is: Topics['doc']['is'] | undefined): string =>
  `${is?.version} ${is?.unsaved} ${is?.disk_hash}`;

const kWaysMs = 100; // for the ways of arrows as they were

/** What is no more, placed in the drawing. */
export function useGhosts(board: PlanBoard, compared: Compared): Ghosts {
  const toolboxes = useTopic('templates', {})?.toolboxes;
  const { model } = board;
  // Not while something is dragged: where elements are, in the file, is in the model.
  return useMemo(
    () => placed(board, model, compared, toolboxes ?? []),
    [board, model, compared, toolboxes],
  );
}

function placed(
  { scene }: PlanBoard,
  model: PlanModel,
  { before, differences }: Compared,
  toolboxes: Toolboxes,
): Ghosts {
  const end = performance.now() + kWaysMs;
  const isTime = () => performance.now() > end;
  return ghostsOf(differences, planModel(before, toolboxes), { model, scene }, isTime);
}
