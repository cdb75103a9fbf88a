import { ViewportPortal } from '@xyflow/react';
import { useMemo } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import { takenIn, type Taken } from '../../../../core/plan/coverage';
import { roundedPath } from '../../../../core/plan/path';
import type { Box, Point } from '../../../../core/plan/shape';
import { shortened } from '../../../../core/plan/strokes';
import { coverageWords as words, shortOf } from '../../tests/words';
import { useBoard } from '../plan_desk';
import { usePlanCoverage } from './use_coverage';
import '../../../look/tests.css';

/** In the drawing: how often each element and each arrow was taken, and what never was. */
export default function CoverageLayer({ board }: { board: PlanBoard }) {
  const { drawing, model } = useBoard(board);
  const counts = usePlanCoverage(board.doc)?.counts;
  const taken = useMemo(() => (counts ? takenIn(model, counts) : []), [model, counts]);
  const elements = taken.flatMap((one) => {
    const box = one.isArrow ? undefined : board.boxOf(one.key);
    return box ? [{ one, box }] : [];
  });
  const ways = taken.flatMap((one) => {
    const points = one.isArrow ? drawing.routes.get(one.key)?.points : undefined;
    return points ? [{ one, points }] : [];
  });
  // Where arrows share a stretch, it was taken if one of them was.
  ways.sort((a, b) => Number(a.one.count > 0) - Number(b.one.count > 0));
  return (
    <ViewportPortal>
      <svg className="pcover-ways" width={1} height={1}>
        {ways.map(({ one, points }) => (
          <Way key={one.key} taken={one} points={points} />
        ))}
      </svg>
      {elements.map(({ one, box }) => (
        <Frame key={one.key} taken={one} box={box} />
      ))}
    </ViewportPortal>
  );
}

const classOf = (name: string, { count }: Taken) =>
  `${name} ${count === 0 ? 'is-never' : 'is-taken'}`;

/** Below another one there is no room for a number: the arrows of a supervisor have its counts. */
function Frame({ taken, box }: { taken: Taken; box: Box }) {
  const hasRoom = !taken.key.includes('/');
  return (
    <div
      className={classOf('pcover', taken)}
      style={{ left: box.x, top: box.y, width: box.width, height: box.height }}
      role="img"
      aria-label={words.mark(taken.key, taken.count)}
      data-covered={taken.key}
      data-count={taken.count}
    >
      {hasRoom ? (
        <span className="pcover__count num" aria-hidden>
          {words.count(taken.count)}
        </span>
      ) : null}
    </div>
  );
}

/** Its count is at its begin, where no other arrow is yet. */
function Way({ taken, points }: { taken: Taken; points: readonly Point[] }) {
  const path = points.length > 1 ? roundedPath(shortened({ id: taken.key, points })) : undefined;
  const text = shortOf(taken.count);
  const width = text.length * 6.5 + 9;
  const spot = behindBegin(points, width / 2 + 3);
  return (
    <g
      className={classOf('pcover-way', taken)}
      role="img"
      aria-label={words.mark(taken.key, taken.count)}
      data-covered={taken.key}
      data-count={taken.count}
    >
      <path className="pcover-way__under" d={path} />
      <path d={path} />
      {spot ? (
        <g className="pcover-way__count" transform={`translate(${spot.x} ${spot.y})`}>
          <rect x={-width / 2} y={-7} width={width} height={14} rx={7} />
          <text dy="0.35em">{text}</text>
        </g>
      ) : null}
    </g>
  );
}

/** So far along its first stretch. */
function behindBegin([from, to]: readonly Point[], far: number): Point | undefined {
  if (!from || !to) return from;
  return {
    x: from.x + Math.sign(to.x - from.x) * far,
    y: from.y + Math.sign(to.y - from.y) * far,
  };
}
