import { ViewportPortal } from '@xyflow/react';
import { useEffect, useMemo } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import type { Compared, Comparing } from '../../../../core/plan/comparing';
import { marksIn, marksOf, type MarkKind } from '../../../../core/plan/differences';
import type { Ghosts } from '../../../../core/plan/ghosts';
import { around, type Box, type Point } from '../../../../core/plan/shape';
import { useStudio } from '../../../hooks';
import { planDeskOf, useBoard } from '../plan_desk';
import { GhostWays, MarkedWay, Sign } from './marked_ways';
import { useComparing, useGhosts } from './use_comparing';
import { compareWords as words } from './words';
import '../../../look/compare.css';

/** In the drawing of a plan that is compared: marks at what differs, ghosts of what is no more. */
export default function DifferencesLayer({ board }: { board: PlanBoard }) {
  const comparing = useComparing(board.doc);
  if (!comparing?.answer) return null;
  return <Layer board={board} comparing={comparing} answer={comparing.answer} />;
}

function Layer(props: { board: PlanBoard; comparing: Comparing; answer: Compared }) {
  const { board, comparing, answer } = props;
  const { drawing } = useBoard(board);
  const marks = useMemo(() => [...marksIn(answer.differences)], [answer]);
  const ghosts = useGhosts(board, answer);
  const current = comparing.current;
  const now = new Set(current ? marksOf(current).map(({ key }) => key) : []);
  useJump(board, ghosts, comparing);
  const elements = marks.flatMap(([key, kind]) => {
    const box = board.arrow(key) ? undefined : board.boxOf(key);
    return box ? [{ key, kind, box }] : [];
  });
  const ways = marks.flatMap(([key, kind]) => {
    const arrow = board.arrow(key);
    const points = drawing.routes.get(key)?.points ?? (arrow ? [arrow.port] : undefined);
    return points ? [{ mark: key, kind, points }] : [];
  });
  return (
    <ViewportPortal>
      <svg className="pdiff-ways" width={1} height={1}>
        <GhostWays ghosts={ghosts} now={now} />
        {ways.map((way) => (
          <MarkedWay key={way.mark} {...way} isCurrent={now.has(way.mark)} />
        ))}
      </svg>
      {elements.map(({ key, kind, box }) => (
        <Frame key={key} mark={key} kind={kind} box={box} isCurrent={now.has(key)} />
      ))}
      {ghosts.elements.map(({ key, name, template, box }) => (
        <Frame key={key} mark={key} kind="removed" box={box} isCurrent={now.has(key)}>
          <b className="ellipsis">{name}</b>
          <span className="ellipsis">{template}</span>
        </Frame>
      ))}
    </ViewportPortal>
  );
}

function Frame(props: {
  mark: string;
  kind: MarkKind;
  box: Box;
  isCurrent: boolean;
  children?: React.ReactNode;
}) {
  const { mark, kind, box, isCurrent, children } = props;
  const classes = ['pdiff', `pdiff--${kind}`];
  if (isCurrent) classes.push('is-current');
  return (
    <div
      className={classes.join(' ')}
      style={{ left: box.x, top: box.y, width: box.width, height: box.height }}
      role="img"
      aria-label={words.mark(mark, kind)}
      data-diff={mark}
      data-diff-kind={kind}
    >
      {children}
      <Sign kind={kind} />
    </div>
  );
}

/** The difference that is looked at comes in sight, and is chosen if it is still there. */
function useJump(board: PlanBoard, ghosts: Ghosts, comparing: Comparing): void {
  const studio = useStudio();
  const { at } = comparing;
  useEffect(() => {
    const { current } = comparing;
    const key = current && marksOf(current)[0]?.key;
    if (at === null || key === undefined) return;
    board.select(key);
    const box = placeOf(board, ghosts, key);
    if (box)
      planDeskOf(studio)
        .find((shown) => shown.board === board)
        ?.showBox(box);
    // What is edited meanwhile is no reason to move the drawing.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [studio, board, comparing, at]);
}

function placeOf(board: PlanBoard, ghosts: Ghosts, key: string): Box | undefined {
  const ghost = ghosts.elements.find((one) => one.key === key)?.box;
  const spots = (points: readonly Point[]): Box =>
    around(points.map(({ x, y }) => ({ x, y, width: 0, height: 0 })));
  const way = board.drawing.routes.get(key) ?? ghosts.arrows.find(({ id }) => id === key)?.route;
  if (way) return spots(way.points);
  return board.boxOf(key) ?? ghost;
}
