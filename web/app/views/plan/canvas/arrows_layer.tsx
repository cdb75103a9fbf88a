import { ViewportPortal } from '@xyflow/react';
import { memo, useMemo } from 'react';
import type { Arrow } from '../../../../core/plan/arrows';
import type { PlanBoard } from '../../../../core/plan/board';
import { roundedPath, type Crossing } from '../../../../core/plan/path';
import type { Routed } from '../../../../core/plan/route';
import { gapPath, gapsOf, shortened } from '../../../../core/plan/strokes';
import { useBoard } from '../plan_desk';
import { text } from '../../../text';
import { DataArrows } from './data_layer';
import { useLive } from './live_store';

/** All arrows of the plan, below its elements. */
export function ArrowsLayer({ board, allData }: { board: PlanBoard; allData: boolean }) {
  const { drawing, selected } = useBoard(board);
  const gaps = useMemo(() => gapsOf(drawing), [drawing]);
  return (
    <ViewportPortal>
      <svg className="parrows" width={1} height={1}>
        <Heads />
        <DataArrows board={board} all={allData} />
        {drawing.arrows.map((arrow) => (
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
        <Drawn board={board} />
      </svg>
    </ViewportPortal>
  );
}

const ActionArrow = memo(function ActionArrow(props: {
  board: PlanBoard;
  arrow: Arrow;
  route: Routed | undefined;
  gaps: readonly Crossing[] | undefined;
  near: boolean;
}) {
  const { board, arrow, route, gaps, near } = props;
  const taken = useLive((live) => live.taken === arrow.id);
  if (!route) return null;
  const kind = taken ? 'taken' : near ? 'near' : 'plain';
  const path = roundedPath(shortened(route));
  return (
    <g
      className={`parrow parrow--${kind}`}
      role="img"
      aria-label={text.draw.arrow(arrow.source, arrow.outcome, arrow.target)}
      onClick={() => board.select(arrow.id)}
    >
      {gaps?.map((gap) => (
        <path key={`${gap.x} ${gap.y}`} className="parrow__gap" d={gapPath(gap)} />
      ))}
      <path className="parrow__hand" d={path} />
      <path className="parrow__line" d={path} markerEnd={`url(#plan-head-${kind})`} />
    </g>
  );
});

function Heads() {
  return (
    <defs>
      {(['plain', 'near', 'taken'] as const).map((kind) => (
        <marker
          key={kind}
          id={`plan-head-${kind}`}
          className={`parrow__head parrow__head--${kind}`}
          viewBox="0 0 10 9"
          refX="1"
          refY="4.5"
          markerWidth="11"
          markerHeight="10"
          markerUnits="userSpaceOnUse"
          orient="auto"
        >
          <path d="M0 0L10 4.5L0 9z" />
        </marker>
      ))}
    </defs>
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
