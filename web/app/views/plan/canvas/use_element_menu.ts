import { useCallback, useState } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import type { PlanNode } from './flow_nodes';

export interface MenuAt {
  of: 'element' | 'canvas';
  x: number;
  y: number;
  /** Gets the keyboard back. */
  beside: HTMLElement | null;
}

/** The menu of the element, row or place under the pointer, or of the element that has the keyboard. */
export function useElementMenu(board: PlanBoard) {
  const [menu, openMenu] = useState<MenuAt | null>(null);
  const onNodeContextMenu = useCallback(
    (event: React.MouseEvent, node: PlanNode) => {
      event.preventDefault();
      const target = event.target instanceof Element ? event.target : null;
      const row = target?.closest<HTMLElement>('[data-plan-row],[data-plan-port]')?.dataset;
      const key = row?.['planRow'] ?? row?.['planPort'] ?? node.id;
      if (!board.selection.has(key)) board.select(key);
      openMenu(menuAt('element', event));
    },
    [board],
  );
  const onPaneContextMenu = useCallback((event: React.MouseEvent | MouseEvent) => {
    event.preventDefault();
    openMenu(menuAt('canvas', event));
  }, []);
  const closeMenu = useCallback(() => openMenu(null), []);
  return { menu, closeMenu, onNodeContextMenu, onPaneContextMenu };
}

function menuAt(of: MenuAt['of'], event: React.MouseEvent | MouseEvent): MenuAt {
  const beside = document.activeElement;
  return {
    of,
    x: event.clientX,
    y: event.clientY,
    beside: beside instanceof HTMLElement ? beside : null,
  };
}
