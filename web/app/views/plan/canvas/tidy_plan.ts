import {
  besideVariables,
  inColumns,
  layoutGraph,
  tidied,
  toTidy,
} from '../../../../core/plan/tidy';
import type { ShownPlan } from '../plan_desk';

/** Places elements again; what the user has placed stays unless it is chosen or all are meant. */
export async function tidy({ board }: ShownPlan): Promise<void> {
  const { model, scene } = board;
  if (model.actors.length === 0) return;
  const wanted = toTidy(model, board.chosenActors);
  const graph = layoutGraph(model, scene, wanted);
  const { elkLayout, TooLong } = await import('./elk_layout');
  try {
    board.place(besideVariables(model, tidied(graph, await elkLayout(graph))));
  } catch (problem) {
    const isWhole = wanted.size > model.actors.length;
    if (!(problem instanceof TooLong) || !isWhole) throw problem;
    board.place(besideVariables(model, inColumns(model)));
  }
}
