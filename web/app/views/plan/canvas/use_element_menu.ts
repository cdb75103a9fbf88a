import { useCallback, useState } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import type { PlanNode } from './flow_nodes';

export interface MenuAt {
  x: number;
  y: number;
  /** Gets the keyboard back. */
  beside: HTMLElement | null;
}

/** The menu of the element or row under the pointer, or of the one that has the keyboard. */
export function useElementMenu(board: PlanBoard) {
  const [menu, openMenu] = useState<MenuAt | null>(null);
  const onNodeContextMenu = useCallback(
    (event: React.MouseEvent, node: PlanNode) => {
      event.preventDefault();
      const target = event.target instanceof Element ? event.target : null;
      const row = target?.closest<HTMLElement>('[data-plan-row],[data-plan-port]')?.dataset;
      const key = row?.['planRow'] ?? row?.['planPort'] ?? node.id;
      if (!board.selection.has(key)) board.select(key);
      const beside = document.activeElement;
      openMenu({
        x: event.clientX,
        y: event.clientY,
        beside: beside instanceof HTMLElement ? beside : null,
      });
    },
    [board],
  );
  const closeMenu = useCallback(() => openMenu(null), []);
  return { menu, closeMenu, onNodeContextMenu };
}
