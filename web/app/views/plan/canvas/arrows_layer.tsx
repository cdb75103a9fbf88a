import { ViewportPortal } from '@xyflow/react';
import { memo, useId, useMemo } from 'react';
import { isEvent, type Arrow } from '../../../../core/plan/arrows';
import type { PlanBoard } from '../../../../core/plan/board';
import { roundedPath, straightPath, type Crossing, type Routed } from '../../../../core/plan/path';
import { gapPath, gapsOf, shortened } from '../../../../core/plan/strokes';
import { useBoard } from '../plan_desk';
import { drawWords } from '../words';
import { ArrowNames } from './arrow_names';
import { DataArrows } from './data_layer';
import { useFar } from './distance';
import { Heads, HeadsContext, useHead } from './heads';
import { useLive } from './live_store';
import { useSeenArrows } from './seen_arrows';

/** The arrows of the plan, below its elements. */
export function ArrowsLayer({ board, allData }: { board: PlanBoard; allData: boolean }) {
  const far = useFar();
  return (
    <>
      <ViewportPortal>
        <HeadsContext value={useId()}>
          <svg className="parrows" width={1} height={1}>
            <Heads />
            <DataArrows board={board} all={allData} />
            {far ? <Lines board={board} /> : <ActionArrows board={board} />}
            <TakenArrow board={board} />
            <Drawn board={board} />
          </svg>
        </HeadsContext>
      </ViewportPortal>
      <ArrowNames board={board} />
    </>
  );
}

function ActionArrows({ board }: { board: PlanBoard }) {
  const { drawing, selected } = useBoard(board);
  const gaps = useMemo(() => gapsOf(drawing), [drawing]);
  const seen = useSeenArrows(drawing);
  return (
    <>
      {seen.map((arrow) => (
        <ActionArrow
          key={arrow.id}
          board={board}
          arrow={arrow}
          route={drawing.routes.get(arrow.id)}
          gaps={gaps.get(arrow.id)}
          near={selected === arrow.id || selected === arrow.source}
        />
      ))}
      {drawing.loose.map(({ id, port }) => {
        const by = port.side === 'left' ? -18 : 18;
        return <path key={id} className="parrow-loose" d={`M${port.x} ${port.y}h${by}`} />;
      })}
    </>
  );
}

/** From far away: the ways alone, in one stroke. */
function Lines({ board }: { board: PlanBoard }) {
  const { drawing } = useBoard(board);
  const path = useMemo(
    () => [...drawing.routes.values()].map(({ points }) => straightPath(points)).join(''),
    [drawing],
  );
  return <path className="parrow-far" d={path} aria-hidden />;
}

function classOf(kind: 'plain' | 'near' | 'taken', source: string | undefined): string {
  return `parrow parrow--${kind}${source && isEvent(source) ? ' parrow--event' : ''}`;
}

const ActionArrow = memo(function ActionArrow(props: {
  board: PlanBoard;
  arrow: Arrow;
  route: Routed | undefined;
  gaps: readonly Crossing[] | undefined;
  near: boolean;
}) {
  const { board, arrow, route, gaps, near } = props;
  const kind = near ? 'near' : 'plain';
  const head = useHead(kind);
  if (!route) return null;
  const path = roundedPath(shortened(route));
  return (
    <g
      className={classOf(kind, arrow.source)}
      role="img"
      aria-label={drawWords.arrow(arrow.source, arrow.outcome, arrow.target)}
      onClick={() => board.select(arrow.id)}
    >
      {gaps?.map((gap) => (
        <path key={`${gap.x} ${gap.y}`} className="parrow__gap" d={gapPath(gap)} />
      ))}
      <path className="parrow__hand" d={path} />
      <path className="parrow__line" d={path} markerEnd={head} />
    </g>
  );
});

/** The arrow that the plan took last, above those with which it shares its way. */
function TakenArrow({ board }: { board: PlanBoard }) {
  const taken = useLive((live) => live.taken);
  const number = useLive((live) => live.takenNumber);
  const head = useHead('taken');
  const route = taken === null ? undefined : board.drawing.routes.get(taken);
  if (!route) return null;
  return (
    // One that is taken again fades again.
    <g key={number} className={classOf('taken', board.arrow(taken)?.source)} aria-hidden>
      <path className="parrow__line" d={roundedPath(shortened(route))} markerEnd={head} />
    </g>
  );
}

/** The arrow under the hand. */
function Drawn({ board }: { board: PlanBoard }) {
  const { drawn } = board;
  const from = drawn && board.arrow(drawn.id)?.port;
  if (!drawn || !from) return null;
  const { x, y } = drawn.at;
  return (
    <g className="parrow-drawn">
      <path d={`M${from.x} ${from.y}L${x} ${y}`} />
      <circle cx={x} cy={y} r={6} />
    </g>
  );
}
