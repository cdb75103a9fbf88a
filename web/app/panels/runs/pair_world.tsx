import { memo } from 'react';
import { placeAt, type Compared } from '../../../core/pairing';
import type { ComparedRun, ComparedShape } from '../../../protocol/messages';
import { runWords as words } from './words';

const degrees = (angle: number) => (-angle * 180) / Math.PI;

/** Both robots in one world, from above: where each went, and where it was at the instant. */
export function PairWorld({ found, t }: { found: Compared; t: number }) {
  const box = boxOf(found);
  if (!box) return null;
  const { x, y, width, height } = box;
  return (
    <svg
      className="runs__world"
      role="img"
      aria-label={words.world}
      viewBox={`${x} ${y} ${width} ${height}`}
      preserveAspectRatio="xMidYMid meet"
    >
      <Scene scene={found.scene} />
      <Ways run={found.a} side="a" />
      <Ways run={found.b} side="b" />
      {(['a', 'b'] as const).map((side) => (
        <Robots
          key={side}
          run={found[side]}
          side={side}
          t={found[side].start + t}
          text={width / 36}
        />
      ))}
    </svg>
  );
}

const Scene = memo(function Scene({ scene }: { scene: readonly ComparedShape[] }) {
  return scene.map(({ round, at, angle, size }, index) => {
    const [x = 0, y = 0] = at;
    const [length = 0, width = 0] = size;
    return round ? (
      <circle key={index} className="runs__thing" cx={x} cy={-y} r={length / 2} />
    ) : (
      <rect
        key={index}
        className="runs__thing"
        x={-length / 2}
        y={-width / 2}
        width={length}
        height={width}
        transform={`translate(${x} ${-y}) rotate(${degrees(angle)})`}
      />
    );
  });
});

const Ways = memo(function Ways({ run, side }: { run: ComparedRun; side: 'a' | 'b' }) {
  return run.ways.map(({ robot, points }) => (
    <polyline key={robot} className={`runs__way runs__way--${side}`} points={lineOf(points)} />
  ));
});

function Robots(props: { run: ComparedRun; side: 'a' | 'b'; t: number; text: number }) {
  const { run, side, t, text } = props;
  return run.ways.map((way) => {
    const place = placeAt(way, t);
    if (!place) return null;
    const [x, y, angle] = place;
    const { length, width } = way;
    return (
      <g key={way.robot} className={`runs__robot runs__robot--${side}`}>
        <rect
          x={-length / 2}
          y={-width / 2}
          width={length}
          height={width}
          transform={`translate(${x} ${-y}) rotate(${degrees(angle)})`}
        />
        <text x={x} y={-y - Math.max(length, width) * 0.7} fontSize={text} textAnchor="middle">
          {side.toUpperCase()}
        </text>
      </g>
    );
  });
}

function lineOf(points: readonly number[]): string {
  const places: string[] = [];
  for (let at = 0; at + 3 < points.length; at += 4)
    places.push(`${points[at + 1]},${-(points[at + 2] ?? 0)}`);
  return places.join(' ');
}

/** Around all that is drawn, in metres; y goes down on a screen. */
function boxOf({ scene, a, b }: Compared) {
  const xs: number[] = [];
  const ys: number[] = [];
  for (const { at, size } of scene) {
    const reach = Math.min(...size) / 2;
    xs.push((at[0] ?? 0) - reach, (at[0] ?? 0) + reach);
    ys.push(-(at[1] ?? 0) - reach, -(at[1] ?? 0) + reach);
  }
  for (const { points, length } of [...a.ways, ...b.ways])
    for (let at = 0; at + 3 < points.length; at += 4) {
      xs.push((points[at + 1] ?? 0) - length, (points[at + 1] ?? 0) + length);
      ys.push(-(points[at + 2] ?? 0) - length, -(points[at + 2] ?? 0) + length);
    }
  if (xs.length === 0) return null;
  const least = (all: number[]) => all.reduce((one, other) => Math.min(one, other));
  const most = (all: number[]) => all.reduce((one, other) => Math.max(one, other));
  const [x, y] = [least(xs), least(ys)];
  return { x, y, width: most(xs) - x, height: most(ys) - y };
}
