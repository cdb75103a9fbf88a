// The running state apart from the drawing: each element looks at its own part only, so that a
// highlight draws two of them anew, whatever the size of the plan.

import { createContext, useContext, useEffect, useState } from 'react';
import { useStore } from 'zustand';
import { createStore, type StoreApi } from 'zustand/vanilla';
import type { PlanBoard } from '../../../../core/plan/board';
import { livePlan, noPlan, type LivePlan } from '../../../../core/plan/live';
import { shownLevel } from '../../../../core/plan_view';
import { ledHere } from '../../../../core/plan/led_here';
import { usePastTime, useShownPlan } from '../../../past_hooks';

export type LiveStore = StoreApi<LivePlan>;
export const LiveContext = createContext<LiveStore>(createStore<LivePlan>()(() => noPlan));

export function useLive<T>(select: (live: LivePlan) => T): T {
  return useStore(useContext(LiveContext), select);
}

/** Follows the running plan, if it is the one on the board. */
export function useLiveStore(board: PlanBoard): LiveStore {
  const [store] = useState(() => createStore<LivePlan>()(() => noPlan));
  const plan = useShownPlan();
  const looksBack = usePastTime() !== null;
  useEffect(() => {
    const level = plan?.levels[shownLevel(plan.levels, board.doc, null)];
    const isOurs = plan !== undefined && plan.state !== 'none' && level?.doc === board.doc;
    const before = looksBack ? noPlan : store.getState();
    const live = isOurs ? livePlan(before, plan, level, board.model, board.drawing) : noPlan;
    const taken = isOurs && looksBack ? ledHere(plan, level, board.drawing) : live.taken;
    store.setState({ ...live, taken }, true);
  }, [store, plan, board, looksBack]);
  return store;
}
