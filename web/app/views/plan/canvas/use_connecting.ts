// Drawing an arrow by hand: from a port to an element; without a mouse, or dropped on nothing, what
// fits is offered as a list.

import { useReactFlow } from '@xyflow/react';
import { createContext, useMemo, useState } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import { kStart } from '../../../../core/plan/model';
import type { Point } from '../../../../core/plan/shape';

export interface Origin {
  id: string;
  source: string;
  outcome: string;
}

export interface Connect {
  begin(event: React.PointerEvent, origin: Origin): void;
  ask(origin: Origin, beside: Element): void;
}

/** null: nothing may be changed. */
export const ConnectContext = createContext<Connect | null>(null);

export interface Asked {
  origin: Origin;
  /** On the screen. */
  x: number;
  y: number;
  /** What has the focus again when nothing is chosen. */
  beside: Element | null;
  /** Where it was dropped, on the canvas. */
  at?: Point;
}

/** A press that moves less than this is a click. */
const kClickPx = 4;

export function useConnecting(board: PlanBoard, drives: boolean) {
  const flow = useReactFlow();
  const [asked, ask] = useState<Asked | null>(null);
  const connect = useMemo<Connect | null>(() => {
    if (!drives) return null;
    const open = (origin: Origin, x: number, y: number, beside: Element | null, at?: Point) =>
      ask({ origin, x, y, beside, ...(at && { at }) });
    return {
      ask(origin, beside) {
        const { right, bottom } = beside.getBoundingClientRect();
        open(origin, right, bottom, beside);
      },
      begin(event, origin) {
        if (event.button !== 0 || !event.isPrimary) return;
        event.stopPropagation();
        const port = event.currentTarget;
        const start = { x: event.clientX, y: event.clientY };
        const { pointerId } = event;
        const end = new AbortController();
        const { signal } = end;
        const isFar = (one: PointerEvent) =>
          Math.hypot(one.clientX - start.x, one.clientY - start.y) > kClickPx;
        const stop = () => {
          end.abort();
          board.draw(null);
        };
        const move = (one: PointerEvent) => {
          if (one.pointerId !== pointerId) return;
          if (board.drawn === null && !isFar(one)) return;
          const at = flow.screenToFlowPosition({ x: one.clientX, y: one.clientY });
          board.draw({ id: origin.id, at });
        };
        const up = (one: PointerEvent) => {
          if (one.pointerId !== pointerId) return;
          const drawn = board.drawn !== null;
          stop();
          const target = drawn ? targetAt(board, origin, one.clientX, one.clientY) : null;
          if (target !== null) board.connect(origin.source, origin.outcome, target);
          else {
            const at = { x: one.clientX, y: one.clientY };
            open(origin, at.x, at.y, port, drawn ? flow.screenToFlowPosition(at) : undefined);
          }
        };
        const key = (one: KeyboardEvent) => {
          if (one.key === 'Escape') stop();
        };
        // After a tap the browser plays a mouse, which would take the focus from the list.
        if (event.pointerType === 'touch')
          port.addEventListener('touchend', (one) => one.cancelable && one.preventDefault(), {
            once: true,
          });
        window.addEventListener('pointermove', move, { signal });
        window.addEventListener('pointerup', up, { signal });
        window.addEventListener('pointercancel', stop, { signal });
        window.addEventListener('keydown', key, { signal, capture: true });
      },
    };
  }, [board, drives, flow]);
  return { connect, asked, close: () => ask(null) };
}

/** The actor under a point of the screen, if an arrow may lead there. */
function targetAt(board: PlanBoard, origin: Origin, x: number, y: number): string | null {
  const under = document.elementFromPoint(x, y)?.closest('[data-plan-actor]');
  const name = under?.getAttribute('data-plan-actor') ?? null;
  const fits = name !== null && name !== kStart && board.actor(name) !== undefined;
  return fits && board.source(origin.source) !== undefined ? name : null;
}
