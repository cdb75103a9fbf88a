// The running state apart from the drawing: each element looks at its own part only, so that a
// highlight draws two of them again, whatever the size of the plan.

import { createContext, useContext, useEffect, useState } from 'react';
import { useStore } from 'zustand';
import { createStore, type StoreApi } from 'zustand/vanilla';
import type { PlanBoard } from '../../../../core/plan/board';
import { livePlan, noPlan, type LivePlan } from '../../../../core/plan/live';
import { shownLevel } from '../../../../core/plan_view';
import { useShownPlan } from '../../../past_hooks';
import { useTriedPlan } from '../try/use_trying';

export type LiveStore = StoreApi<LivePlan>;
export const LiveContext = createContext<LiveStore>(createStore<LivePlan>()(() => noPlan));

export function useLive<T>(select: (live: LivePlan) => T): T {
  return useStore(useContext(LiveContext), select);
}

/** Follows the running plan, if it is the one on the board. */
export function useLiveStore(board: PlanBoard): LiveStore {
  const [store] = useState(() => createStore<LivePlan>()(() => noPlan));
  const tried = useTriedPlan();
  const shown = useShownPlan();
  const plan = tried ?? shown;
  useEffect(() => {
    const level = plan?.levels[shownLevel(plan.levels, board.doc, null)];
    const isOurs = plan !== undefined && plan.state !== 'none' && level?.doc === board.doc;
    store.setState(isOurs ? livePlan(plan, level, board.model) : noPlan, true);
  }, [store, plan, board]);
  return store;
}
