import { useReactFlow, useStore } from '@xyflow/react';
import { useEffect } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import { kStart } from '../../../../core/plan/model';
import { useWindow } from '../../../hooks';
import { kPresented } from './fitted';
import { useLive } from './live_store';

/** Of a plan that is too large to be read as a whole, Present shows where it is, at first its start. Draws nothing. */
export function Presented({ board }: { board: PlanBoard }) {
  const flow = useReactFlow();
  const presents = useWindow((state) => state.layout === 'Present');
  const isPart = useStore(({ transform: [, , zoom] }) => zoom <= kPresented.minZoom);
  const actor = useLive((live) => live.actor);
  useEffect(() => {
    const box = presents && isPart ? (board.boxOf(actor) ?? board.boxOf(kStart)) : undefined;
    if (!box) return;
    const { x, y, width, height } = box;
    void flow.setCenter(x + width / 2, y + height / 2, { zoom: kPresented.minZoom });
  }, [flow, presents, isPart, board, actor]);
  return null;
}
