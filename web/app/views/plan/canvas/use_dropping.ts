// A template dragged from the palette onto the canvas.

import { useReactFlow } from '@xyflow/react';
import { useMemo } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import { kStart } from '../../../../core/plan/model';
import { useTopic } from '../../../hooks';
import { foundIn, kTemplateData } from '../template_drag';
import { roomOf } from './canvas_hooks';

export function useDropping(board: PlanBoard, drives: boolean) {
  const flow = useReactFlow();
  const toolboxes = useTopic('templates', {})?.toolboxes;
  return useMemo(
    () => ({
      onDragOver(event: React.DragEvent) {
        if (!drives || !event.dataTransfer.types.includes(kTemplateData)) return;
        event.preventDefault();
        event.dataTransfer.dropEffect = 'copy';
      },
      onDrop(event: React.DragEvent) {
        const found = foundIn(toolboxes ?? [], event.dataTransfer.getData(kTemplateData));
        if (!drives || !found) return;
        event.preventDefault();
        // Keys are for the plan that got it.
        const frame = event.currentTarget;
        if (!(frame instanceof HTMLElement)) return;
        frame.focus({ preventScroll: true });
        const at = { x: event.clientX, y: event.clientY };
        if (found.template.kind !== 'supervisor') {
          const { x, y } = flow.screenToFlowPosition(at);
          board.dropActor(found, { x: x - 84, y: y - 22 }, roomOf(flow, frame));
          return;
        }
        const under = document.elementFromPoint(at.x, at.y)?.closest('[data-plan-actor]');
        board.addSupervisor(found, under?.getAttribute('data-plan-actor') ?? kStart);
      },
    }),
    [board, drives, flow, toolboxes],
  );
}
