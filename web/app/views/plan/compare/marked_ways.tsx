import type { MarkKind } from '../../../../core/plan/differences';
import type { Ghosts } from '../../../../core/plan/ghosts';
import { roundedPath } from '../../../../core/plan/path';
import type { Point } from '../../../../core/plan/shape';
import { nameSpot, shortened } from '../../../../core/plan/strokes';
import { compareWords as words } from './words';

/** At the corner of an element: what happened to it, told by its sign as well as its colour. */
export function Sign({ kind }: { kind: MarkKind }) {
  return (
    <span className={`pdiff__sign pdiff__sign--${kind} pdiff__corner`} aria-hidden>
      {words.signs[kind]}
    </span>
  );
}

/** An arrow that is new, leads elsewhere, or is no more; of one that leads nowhere only its sign. */
export function MarkedWay(props: {
  mark: string;
  kind: MarkKind;
  points: readonly Point[];
  isCurrent: boolean;
}) {
  const { mark, kind, points, isCurrent } = props;
  const route = { id: mark, points };
  const spot = nameSpot(route) ?? points[0];
  return (
    <g
      className={classOf(`pdiff-way pdiff-way--${kind}`, isCurrent)}
      role="img"
      aria-label={words.mark(mark, kind)}
      data-diff={mark}
      data-diff-kind={kind}
    >
      {points.length > 1 ? <path d={roundedPath(shortened(route))} /> : null}
      {spot ? (
        <g className="pdiff-way__sign" transform={`translate(${spot.x} ${spot.y})`}>
          <circle r={9} />
          <text dy="0.35em">{words.signs[kind]}</text>
        </g>
      ) : null}
    </g>
  );
}

/** Ways of arrows as they were: of those that are removed, and of those that lead elsewhere now. */
export function GhostWays({ ghosts, now }: { ghosts: Ghosts; now: ReadonlySet<string> }) {
  return ghosts.arrows.map(({ id, route, is }) =>
    is === 'removed' ? (
      <MarkedWay key={id} mark={id} kind="removed" points={route.points} isCurrent={now.has(id)} />
    ) : (
      <g key={id} className={classOf('pdiff-way pdiff-way--was', now.has(id))} aria-hidden>
        <path d={roundedPath(shortened(route))} />
      </g>
    ),
  );
}

const classOf = (classes: string, isCurrent: boolean) =>
  isCurrent ? `${classes} is-current` : classes;
