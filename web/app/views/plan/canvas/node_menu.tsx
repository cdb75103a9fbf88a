import { Menu } from '@mantine/core';
import { useCallback, useState, type MouseEvent } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import { CommandItem, StudioMenu } from '../../../parts/menu';
import { text } from '../../../text';
import type { PlanNode } from './flow_nodes';

export interface AskedNode {
  x: number;
  y: number;
  /** Where the keyboard was. */
  beside: Element | null;
}

/** A press with the other button on an element, or the menu key on it, asks what can be done with it. */
export function useNodeMenu(board: PlanBoard) {
  const [asked, ask] = useState<AskedNode | null>(null);
  const onNodeContextMenu = useCallback(
    (event: MouseEvent, node: PlanNode) => {
      const frame = event.currentTarget.closest('.pcanvas')?.getBoundingClientRect();
      if (!frame || !board.element(node.id)) return;
      event.preventDefault();
      board.select(node.id);
      const { left, top } = frame;
      const beside = document.activeElement;
      ask({ x: event.clientX - left, y: event.clientY - top, beside });
    },
    [board],
  );
  const close = useCallback(() => ask(null), []);
  return { asked, onNodeContextMenu, close };
}

/** What can be done with the element that is chosen. */
export function NodeMenu({ asked, onClose }: { asked: AskedNode; onClose: () => void }) {
  return (
    <StudioMenu
      opened
      onClose={() => {
        onClose();
        if (asked.beside instanceof HTMLElement) asked.beside.focus();
      }}
      button={<span className="pasked" style={{ left: asked.x, top: asked.y }} />}
    >
      <CommandItem id="draw.runFrom" title={text.plan.from.menu} />
      <Menu.Divider />
      <CommandItem id="draw.rename" title={text.draw.rename} />
      <CommandItem id="draw.duplicate" title={text.plan.from.duplicate} />
      <CommandItem id="draw.remove" title={text.draw.remove} />
    </StudioMenu>
  );
}
