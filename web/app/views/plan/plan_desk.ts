// The plans that are drawn: palette, forms and commands are about the one that was used last.

import { useCallback, useSyncExternalStore } from 'react';
import { Emitter } from '../../../core/emitter';
import type { PlanBoard } from '../../../core/plan/board';
import type { Point } from '../../../core/plan/shape';
import type { Studio } from '../../../core/studio';

export interface ShownPlan {
  board: PlanBoard;
  /** The middle of what is seen, on the canvas. */
  middle(): Point;
  /** Brings the keyboard to an element. */
  focus(key: string): void;
}

export class PlanDesk {
  readonly changed = new Emitter<void>();
  /** Someone works on a plan. */
  readonly used = new Emitter<void>();
  /** The name of what is chosen is to be changed. */
  readonly renames = new Emitter<void>();
  version = 0;
  private readonly plans: ShownPlan[] = [];

  get shown(): ShownPlan | undefined {
    return this.plans.at(-1);
  }

  add(plan: ShownPlan): () => void {
    this.plans.unshift(plan);
    this.tell();
    return () => {
      this.plans.splice(this.plans.indexOf(plan), 1);
      this.tell();
    };
  }

  use(plan: ShownPlan): void {
    this.used.emit();
    const at = this.plans.indexOf(plan);
    if (this.shown === plan || at < 0) return;
    this.plans.splice(at, 1);
    this.plans.push(plan);
    this.tell();
  }

  private tell(): void {
    this.version++;
    this.changed.emit();
  }
}

const desks = new WeakMap<Studio, PlanDesk>();

export function planDeskOf(studio: Studio): PlanDesk {
  const known = desks.get(studio);
  if (known) return known;
  const made = new PlanDesk();
  desks.set(studio, made);
  return made;
}

export function usePlanDesk(studio: Studio): PlanDesk {
  const desk = planDeskOf(studio);
  useSyncExternalStore(
    useCallback((listener: () => void) => desk.changed.on(listener), [desk]),
    () => desk.version,
  );
  return desk;
}

export function useBoard(board: PlanBoard): PlanBoard {
  useSyncExternalStore(
    useCallback((listener: () => void) => board.changed.on(listener), [board]),
    () => board.version,
  );
  return board;
}
