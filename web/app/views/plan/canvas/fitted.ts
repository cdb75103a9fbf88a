// What is seen of a plan: all of it at first, and then what a person chose. Nothing else moves it.

import { useNodesInitialized, useReactFlow, useStore, useStoreApi } from '@xyflow/react';
import { useCallback, useEffect, useMemo, useRef } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import type { View } from '../../../../core/plan/views';
import { useStudio, useWindow } from '../../../hooks';
import { keptViews } from './kept_views';

/** Room around the boxes for the arrows that go around them. */
export const kFit = { padding: { x: '48px', y: '24px' }, maxZoom: 1 } as const;
/** Where one only looks, a small plan fills its panel, too; names have no room in smaller boxes. */
export const kPresented = { padding: { x: '48px', y: '20px' }, minZoom: 0.55, maxZoom: 2 } as const;

/** Where a canvas begins: where its plan was looked at last, in any layout; undefined: all of it in sight. */
export function useFirstView({ doc }: PlanBoard) {
  const studio = useStudio();
  const presents = useWindow((state) => state.layout === 'Present');
  return useMemo(
    () => (presents ? undefined : keptViews(studio).get(doc)),
    [studio, doc, presents],
  );
}

/**
 * The whole plan is in sight while its panel finds its size, until somebody works on it: the function that is given
 * says so. From then on the drawing stays at its place on the screen, also when a line comes above it or a panel beside
 * it changes, and in its panel, when another layout shows it.
 * The layout Present shows the whole of it, as far as its names can be read then.
 */
export function useFitted(board: PlanBoard, frame: React.RefObject<HTMLElement | null>) {
  const studio = useStudio();
  const flow = useReactFlow();
  const width = useStore((state) => state.width);
  const height = useStore((state) => state.height);
  // Boxes have their sizes once they were drawn.
  const measured = useNodesInitialized();
  const presents = useWindow((state) => state.layout === 'Present');
  const views = keptViews(studio);
  const { doc, file } = board;
  const worksOn = useRef(views.get(doc) !== undefined);
  const corner = useRef<Corner | null>(null);
  /** Between the canvas and the panel: lines come and go there. */
  const inset = useRef<Corner>({ left: 0, top: 0 });
  useEffect(() => {
    if (width === 0 || height === 0 || !frame.current) return;
    const { left, top } = frame.current.getBoundingClientRect();
    const before = corner.current;
    corner.current = { left, top };
    inset.current = insetOf(frame.current);
    if (presents)
      return void flow.fitView(kPresented).then(() => {
        // Names are so large on the screen, whatever the zoom is (look/present.css).
        frame.current?.style.setProperty('--zoom', String(flow.getZoom()));
      });
    if (!worksOn.current && !file.canUndo) return void flow.fitView(kFit);
    const kept = before ? undefined : views.get(doc);
    if (kept) return void flow.setViewport(moved(kept, inset.current, -1));
    if (!before || (before.left === left && before.top === top)) return;
    const by = { left: left - before.left, top: top - before.top };
    void flow.setViewport(moved(flow.getViewport(), by, -1));
  }, [doc, file, views, flow, frame, width, height, presents, measured]);
  const store = useStoreApi();
  const keep = useCallback(() => {
    const [x, y, zoom] = store.getState().transform;
    if (worksOn.current && !presents) views.keep(doc, moved({ x, y, zoom }, inset.current, 1));
  }, [store, views, doc, presents]);
  const work = useCallback(() => {
    // A plan that is paused shows its active actor before the canvas is where it was left.
    if (corner.current === null) return;
    worksOn.current = true;
    keep();
  }, [keep]);
  useEffect(() => {
    const ends = [
      store.subscribe((now, before) => now.transform !== before.transform && keep()),
      file.changed.on(() => file.canUndo && work()),
    ];
    return () => ends.forEach((end) => end());
  }, [store, file, keep, work]);
  return work;
}

interface Corner {
  left: number;
  top: number;
}

function insetOf(frame: HTMLElement): Corner {
  const { left, top } = frame.getBoundingClientRect();
  const panel = frame.closest('[data-tab-content]')?.getBoundingClientRect();
  return { left: left - (panel?.left ?? left), top: top - (panel?.top ?? top) };
}

function moved({ x, y, zoom }: View, { left, top }: Corner, times: 1 | -1): View {
  return { x: x + times * left, y: y + times * top, zoom };
}
