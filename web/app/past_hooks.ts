// How components look at what is shown: now, or an instant of the past. The one place that knows which.

import { useCallback, useSyncExternalStore } from 'react';
import type { OpenTrace, PlanThen } from '../core/past';
import type { Happening, HistoryNode, NodeId, Topics } from '../protocol/messages';
import { useDrives, useStudio, useTopic } from './hooks';

function usePastPart<T>(select: () => T): T {
  const { past } = useStudio();
  const subscribe = useCallback((listener: () => void) => past.changed.on(listener), [past]);
  return useSyncExternalStore(subscribe, select);
}

/** The instant that is looked back at, in seconds; null: now. */
export function usePastTime(): number | null {
  const { past } = useStudio();
  return usePastPart(() => past.at);
}

/** That instant is what is shown; its answer may not have come yet. */
export function useIsPastShown(): boolean {
  const { past } = useStudio();
  return usePastPart(() => past.shown === past.at);
}

/** The name of the trace that is open as a file; null: it is a run that is looked at. */
export function useTraceName(): string | null {
  const { past } = useStudio();
  return usePastPart(() => past.trace?.path ?? null);
}

/** What that trace is asked as, and the robots that have plans in it. */
export function useTraceOpen(): OpenTrace | null {
  const { past } = useStudio();
  return usePastPart(() => past.trace);
}

/** What is in the world that is shown: the one that runs, or that of the trace. */
export function useScene(on = true): Topics['scene']['is'] | undefined {
  const now = useTopic('scene', on ? {} : null);
  const then = useTraceOpen()?.scene;
  return on ? (then ?? now) : undefined;
}

/** Until when something is known of what is looked at. */
export function useEnd(): number {
  const { past } = useStudio();
  const to = useTopic('history', {})?.to ?? 0;
  return usePastPart(() => past.trace?.to ?? to);
}

/** The plan as it is shown. */
export function useShownPlan(): PlanThen | undefined {
  const { past } = useStudio();
  const now = useTopic('plan', {});
  const then = usePastPart(() => (past.at === null || !past.instant ? null : past.instant));
  return then ? (past.plan ?? undefined) : now;
}

/** The last happenings until the instant that is shown; null: all that are known now. */
export function usePastEvents(): readonly Happening[] | null {
  const { past } = useStudio();
  return usePastPart(() => (past.at === null ? null : (past.instant?.events ?? null)));
}

/** What a node did at the instant that is shown, and where it was; null: what it does now is shown. */
export function useNodeThen(node: NodeId | undefined): Partial<HistoryNode> | null {
  const { past } = useStudio();
  const nodes = usePastPart(() => (past.at === null ? null : (past.instant?.nodes ?? kNoNodes)));
  return nodes && (nodes.find((one) => one.node === node) ?? {});
}
const kNoNodes: readonly HistoryNode[] = [];

/** True if this page may change what runs: it drives, and shows now. */
export function useMayAct(): boolean {
  const drives = useDrives();
  return usePastTime() === null && drives;
}
