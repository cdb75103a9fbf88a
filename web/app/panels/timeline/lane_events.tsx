import { placeIn } from '../../../core/timeline';
import { words } from './words';
import { extentOf, fitting, type LaneShape } from './lane_view';

/** Events of one source: marks, and bars where they come one after the other. */
export function Events({ lane, view, height }: LaneShape) {
  const { span, width } = view;
  const places = lane.marks.map(({ t }) => placeIn(span, t, width));
  const runs = lane.bars.map(({ from }) => placeIn(span, from, width));
  return (
    <>
      {lane.bars.map((bar) => (
        <rect
          key={bar.from}
          {...extentOf(bar, view)}
          y={height / 2 - 4}
          height={8}
          className="tl__run"
        >
          <title>{[bar.name, words.many(bar.count ?? 1)].filter(Boolean).join(': ')}</title>
        </rect>
      ))}
      {lane.marks.map(({ t, name, count }, index) => {
        const x = places[index] ?? 0;
        const room = nextAfter(x, [...places, ...runs], width) - x - 12;
        return (
          <g key={t}>
            <path d={`M${x.toFixed(1)} 3V${height - 3}`} className="tl__event">
              <title>{name ?? words.many(count ?? 1)}</title>
            </path>
            <text x={x + 4} y={height / 2 + 4} className="tl__label">
              {fitting(name ?? '', room)}
            </text>
          </g>
        );
      })}
    </>
  );
}

/** Where the next thing in the lane begins. */
function nextAfter(x: number, places: readonly number[], width: number): number {
  return places.reduce((least, one) => (one > x ? Math.min(least, one) : least), width);
}
