import { createContext, useContext, useMemo } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import { discOf, keyOfBreak, type Disc } from '../../../../core/plan/breaks';
import { useTopic } from '../../../hooks';
import { drawWords } from '../words';
import { useBoard } from '../plan_desk';
import { useLive } from './live_store';

export interface Dot {
  number: number;
  disc: Disc;
  label: string;
}

/** Breakpoints by the key of what they are at. */
export const DotsContext = createContext<ReadonlyMap<string, Dot>>(new Map());

/** The same map as long as nothing is drawn otherwise: hits do not draw the plan again. */
export function useDots(board: PlanBoard): ReadonlyMap<string, Dot> {
  const all = useTopic('breakpoints', {})?.plans;
  const { model } = useBoard(board);
  const told = useMemo(() => {
    const dots = (all ?? []).flatMap((one): [string, Dot][] => {
      const key = one.doc === board.doc ? keyOfBreak(model, one) : null;
      if (key === null) return [];
      return [[key, { number: one.number, disc: discOf(one), label: drawWords.break.dot(one) }]];
    });
    return JSON.stringify(dots);
  }, [all, model, board]);
  return useMemo(() => new Map(JSON.parse(told) as [string, Dot][]), [told]);
}

/** A red disc at an actor, a row or a supervisor that has a breakpoint. */
export function BreakDot({ at }: { at: string }) {
  const dot = useContext(DotsContext).get(at);
  return dot ? <Shown {...dot} /> : null;
}

function Shown({ number, disc, label }: Dot) {
  const holds = useLive((live) => live.pausedLineOf.includes(number));
  const classes = ['disc', 'pdot', `disc--${disc}`];
  if (holds) classes.push('is-hit');
  return <span className={classes.join(' ')} role="img" aria-label={label} title={label} />;
}
