import { curvePaths, drawnCurve, nearestPoint } from '../../../core/deciding';
import { shownTime } from '../../../core/numbers';
import type { Turning, TurningPoint } from '../../../protocol/messages';
import { decidedWords as words } from './decided_words';

const kSize = { width: 260, height: 90 };
const kBeside = { left: 30, top: 8, right: 10, bottom: 18 };

/** In how many continuations it became true, over time; the same as numbers below. */
export function DecidedCurve({ result, onLook }: { result: Turning; onLook(t: number): void }) {
  const { curve, end, turn, came, sentence } = result;
  const until = came ?? end;
  const points = drawnCurve(curve, until, kSize);
  const { line, band } = curvePaths(points);
  const width = kSize.width + kBeside.left + kBeside.right;
  const height = kSize.height + kBeside.top + kBeside.bottom;
  const atTurn = turn && until > 0 ? (turn.after.t / until) * kSize.width : null;
  const look = (event: React.MouseEvent<SVGSVGElement>) => {
    const box = event.currentTarget.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * width - kBeside.left;
    const nearest = nearestPoint(points, x);
    if (nearest) onLook(nearest.point.t);
  };
  return (
    <>
      <svg
        className="decided__curve"
        viewBox={`0 0 ${width} ${height}`}
        role="img"
        aria-label={words.chart(sentence)}
        onClick={look}
      >
        <g transform={`translate(${kBeside.left} ${kBeside.top})`}>
          <text x={-6} y={4} textAnchor="end">
            {words.all}
          </text>
          <text x={-6} y={kSize.height} textAnchor="end">
            {words.none}
          </text>
          <line x1={0} y1={0} x2={kSize.width} y2={0} className="decided__grid" />
          <line
            x1={0}
            y1={kSize.height}
            x2={kSize.width}
            y2={kSize.height}
            className="decided__axis"
          />
          <path d={band} className="decided__band" />
          <path d={line} className="decided__line" />
          {points.map(({ x, y, point }) => (
            <circle key={point.t} cx={x} cy={y} r={2.2} className="decided__point" />
          ))}
          {atTurn === null ? null : (
            <line x1={atTurn} y1={-4} x2={atTurn} y2={kSize.height} className="decided__turn" />
          )}
          <text x={0} y={kSize.height + 13}>
            0 s
          </text>
          <text x={kSize.width} y={kSize.height + 13} textAnchor="end">
            {shownTime(until)} s
          </text>
        </g>
      </svg>
      <details className="decided__numbers">
        <summary>{words.table}</summary>
        <table>
          <caption className="hidden-text">{words.curve}</caption>
          <thead>
            <tr>
              <th scope="col">{words.instant}</th>
              <th scope="col">{words.share}</th>
              <th scope="col">{words.likely}</th>
            </tr>
          </thead>
          <tbody>
            {curve.map((point) => (
              <Row key={point.t} point={point} onLook={onLook} />
            ))}
          </tbody>
        </table>
      </details>
    </>
  );
}

function Row({ point, onLook }: { point: TurningPoint; onLook(t: number): void }) {
  const { t, came, of, low, high, end } = point;
  return (
    <tr>
      <th scope="row">
        <button type="button" className="num" onClick={() => onLook(t)}>
          {shownTime(t)} s
        </button>
      </th>
      <td className="num">{end ? words.end : words.of(came, of)}</td>
      <td className="num">{end ? '' : words.percent(low, high)}</td>
    </tr>
  );
}
