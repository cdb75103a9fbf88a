import { layoutGraph, tidied, toTidy } from '../../../../core/plan/tidy';
import type { ShownPlan } from '../plan_desk';

/** Places elements anew; what the user has placed stays unless it is chosen or all are meant. */
export async function tidy({ board }: ShownPlan): Promise<void> {
  const { model, scene } = board;
  if (model.actors.length === 0) return;
  const graph = layoutGraph(model, scene, toTidy(model, board.chosenActors));
  const { elkLayout } = await import('./elk_layout');
  board.place(tidied(graph, await elkLayout(graph)));
}
