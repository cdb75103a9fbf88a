// What is seen of a plan: all of it at first, and then what a person chose. Nothing else moves it.

import { useNodesInitialized, useReactFlow, useStore } from '@xyflow/react';
import { useCallback, useEffect, useRef } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import { useWindow } from '../../../hooks';

/** Room around the boxes for the arrows that go around them. */
export const kFit = { padding: { x: '48px', y: '24px' }, maxZoom: 1 } as const;
/** Where one only looks, a small plan fills its panel, too. */
const kPresented = { padding: { x: '48px', y: '20px' }, maxZoom: 2 } as const;

/**
 * The whole plan is in sight while its panel finds its size, until somebody works on it. From then on
 * the drawing stays at its place on the screen, also when a line comes above it or a panel beside it changes.
 * The layout Present always shows the whole of it.
 */
export function useFitted(board: PlanBoard, frame: React.RefObject<HTMLElement | null>) {
  const flow = useReactFlow();
  const width = useStore((state) => state.width);
  const height = useStore((state) => state.height);
  // Boxes have their sizes once they were drawn.
  const measured = useNodesInitialized();
  const presents = useWindow((state) => state.layout === 'Present');
  const worksOn = useRef(false);
  const corner = useRef<{ left: number; top: number } | null>(null);
  useEffect(() => {
    if (width === 0 || height === 0 || !frame.current) return;
    const { left, top } = frame.current.getBoundingClientRect();
    const before = corner.current;
    corner.current = { left, top };
    if (presents)
      return void flow.fitView(kPresented).then(() => {
        // Names are so large on the screen, whatever the zoom is (look/present.css).
        frame.current?.style.setProperty('--zoom', String(flow.getZoom()));
      });
    if (!worksOn.current && !board.file.canUndo) return void flow.fitView(kFit);
    if (!before || (before.left === left && before.top === top)) return;
    const { x, y, zoom } = flow.getViewport();
    void flow.setViewport({ x: x + before.left - left, y: y + before.top - top, zoom });
  }, [board, flow, frame, width, height, presents, measured]);
  return useCallback(() => void (worksOn.current = true), []);
}
