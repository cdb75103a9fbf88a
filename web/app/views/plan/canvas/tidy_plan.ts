import {
  besideNotes,
  besideVariables,
  inColumns,
  layoutGraph,
  tidied,
  toTidy,
} from '../../../../core/plan/tidy';
import type { Point } from '../../../../core/plan/shape';
import type { ShownPlan } from '../plan_desk';

/** Places elements again; what the user has placed stays unless it is chosen or all are meant. */
export async function tidy({ board }: ShownPlan): Promise<void> {
  const { model, scene } = board;
  if (model.actors.length === 0) return;
  const wanted = toTidy(model, board.chosenActors);
  const graph = layoutGraph(model, scene, wanted);
  const place = (places: [string, Point][]) =>
    board.place(besideNotes(model, besideVariables(model, places)));
  const { elkLayout, TooLong } = await import('./elk_layout');
  try {
    place(tidied(graph, await elkLayout(graph)));
  } catch (problem) {
    const isWhole = wanted.size > model.actors.length;
    if (!(problem instanceof TooLong) || !isWhole) throw problem;
    place(inColumns(model));
  }
}
