import type { Topics } from '../../../protocol/messages';
import { shortCount } from '../../../core/numbers';
import type { Picture } from '../../../core/traffic';
import { words } from './words';

/** Where many arrows meet, the bus is larger, so that they do not run into one. */
export function hubRadius({ spots }: Picture): number {
  return Math.min(84, Math.max(26, spots.size * 0.9));
}

/** How loaded the bus is, what is said on it, what was lost. */
export function BusLine({ robot }: { robot: Topics['robot']['is'] }) {
  const { load, events_a_second: events, lost } = robot;
  return (
    <p className="network__bus num">
      <b>{words.bus}</b>
      {load === undefined ? null : <span>{words.load(load.toFixed(1))}</span>}
      <span>{words.events(shortCount(events))}</span>
      <span className={lost > 0 ? 'is-warning' : undefined}>{words.lost(shortCount(lost))}</span>
    </p>
  );
}

/** The bus as a ring on which the nodes are drawn. */
export function Ring({ picture: { centre, ring } }: { picture: Picture }) {
  return <ellipse className="net__ring" cx={centre.x} cy={centre.y} rx={ring.x} ry={ring.y} />;
}

/** The bus in the middle, where all arrows go to it and come from it. */
export function Hub({ picture }: { picture: Picture }) {
  const { centre } = picture;
  return (
    <g className="net__hub">
      <circle cx={centre.x} cy={centre.y} r={hubRadius(picture)} />
      <text className="net__title" x={centre.x} y={centre.y + 4} textAnchor="middle">
        {words.bus}
      </text>
    </g>
  );
}

export function Markers() {
  return (
    <defs>
      {['out', 'in', 'all'].map((kind) => (
        <marker
          key={kind}
          id={`net-${kind}`}
          viewBox="0 0 8 8"
          refX="2"
          refY="4"
          markerUnits="userSpaceOnUse"
          markerWidth="9"
          markerHeight="9"
          orient="auto-start-reverse"
        >
          <path className={`net__head net__head--${kind}`} d="M0 .5L8 4L0 7.5z" />
        </marker>
      ))}
    </defs>
  );
}
