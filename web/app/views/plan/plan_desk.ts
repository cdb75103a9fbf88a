// The plans that are drawn: palette, forms and commands are about the one that was used last.

import { Desk, deskFor } from '../../../core/desk';
import { Emitter } from '../../../core/emitter';
import type { PlanBoard } from '../../../core/plan/board';
import type { Box, Point } from '../../../core/plan/shape';
import type { Studio } from '../../../core/studio';
import { useChanges } from '../../hooks';

export interface ShownPlan {
  board: PlanBoard;
  /** The middle of what is seen, on the canvas. */
  middle(): Point;
  /** What is seen of the plan. */
  room(): Box;
  zoom(): number;
  zoomed: Emitter<void>;
  /** Around the middle. */
  zoomTo(zoom: number): void;
  /** Brings an element in sight. */
  show(key: string): void;
  /** The same of a part of the canvas. */
  showBox(box: Box): void;
  /** Brings the keyboard to an element; stays: nothing moves as long as some of it is seen. */
  focus(key: string, how?: { stays?: boolean }): void;
}

export class PlanDesk extends Desk<ShownPlan> {
  private asked = false;
  private readonly renames = new Emitter<void>();

  /** The name of what is chosen is to be changed, by the view that shows it or comes to show it. */
  rename(): void {
    this.asked = true;
    this.renames.emit();
  }

  /** Calls `begin` when the name is to be changed. */
  onRename(begin: () => void): () => void {
    const take = () => {
      if (this.asked) begin();
      this.asked = false;
    };
    take();
    return this.renames.on(take);
  }
}

export const planDeskOf: (studio: Studio) => PlanDesk = deskFor(() => new PlanDesk());

export function usePlanDesk(studio: Studio): PlanDesk {
  const desk = planDeskOf(studio);
  useChanges(desk.changed);
  return desk;
}

export function useBoard(board: PlanBoard): PlanBoard {
  useChanges(board.changed);
  return board;
}
