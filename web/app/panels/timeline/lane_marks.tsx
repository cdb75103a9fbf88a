import { memo } from 'react';
import { placeIn } from '../../../core/timeline';
import { Curve } from './lane_curve';
import { Events } from './lane_events';
import { extentOf, fitting, type LaneShape, type LaneView } from './lane_view';
import { words } from './words';
import type { Row } from './rows';

/** What is in one row; drawn again when something in it looks different. */
export const LaneShapes = memo(Shapes, (a, b) => a.row === b.row && looksAlike(a, b));

function Shapes({ row, view }: { row: Row; view: LaneView }) {
  switch (row.is) {
    case 'actors':
      return <Bars lane={row.lane} view={view} height={row.height} />;
    case 'supervisor':
      return <Watching lane={row.lane} view={view} height={row.height} />;
    case 'events':
      return <Events lane={row.lane} view={view} height={row.height} />;
    case 'curve':
    case 'load':
      return (
        <Curve curve={row.curve} view={view} height={row.height - 8} load={row.is === 'load'} />
      );
  }
}

function Bars({ lane, view, height }: LaneShape) {
  return lane.bars.map((bar) => {
    const place = extentOf(bar, view);
    const on = bar.from <= view.at && view.at < (bar.to ?? Infinity);
    const name = bar.name ?? (bar.count ? words.many(bar.count) : '');
    return (
      <g key={bar.from}>
        <rect
          {...place}
          y={4}
          height={height - 8}
          rx={3}
          className={on ? 'tl__actor is-on' : 'tl__actor'}
        >
          <title>{[name, bar.end].filter(Boolean).join(' → ')}</title>
        </rect>
        <text x={Math.max(place.x, 0) + 6} y={height / 2 + 4} className={on ? 'tl__name' : ''}>
          {fitting(name, place.width + Math.min(place.x, 0) - 10)}
        </text>
      </g>
    );
  });
}

function Watching({ lane, view, height }: LaneShape) {
  const { span, width } = view;
  const places = lane.marks.map(({ t }) => placeIn(span, t, width));
  return (
    <>
      {lane.bars.map((bar) => (
        <rect
          key={bar.from}
          {...extentOf(bar, view)}
          y={height / 2 - 3}
          height={6}
          rx={3}
          className="tl__watch"
        />
      ))}
      {lane.marks.map(({ t, name, to, count }, index) => {
        const x = places[index] ?? 0;
        const room = (places[index + 1] ?? width) - x - 16;
        return (
          <g key={t}>
            <path d={hexagon(x, height / 2)} className="tl__raised">
              <title>{[name ?? words.many(count ?? 1), to].filter(Boolean).join(' → ')}</title>
            </path>
            <text x={x + 10} y={height / 2 + 4} className="tl__label">
              {fitting(name ?? '', room)}
            </text>
          </g>
        );
      })}
    </>
  );
}

function hexagon(x: number, y: number): string {
  return `M${x - 7} ${y}l3.5 -6h7l3.5 6l-3.5 6h-7z`;
}

/** The cursor and now matter to actors and to what is still open. */
function looksAlike(a: { row: Row; view: LaneView }, b: { row: Row; view: LaneView }): boolean {
  const [one, other] = [a.view, b.view];
  const same =
    one.width === other.width &&
    one.span.from === other.span.from &&
    one.span.to === other.span.to &&
    one.answered === other.answered;
  if (!same || 'curve' in a.row) return same;
  const open = a.row.lane.bars.at(-1)?.to === undefined && a.row.is !== 'events';
  if (open && one.end !== other.end) return false;
  return a.row.is !== 'actors' || one.at === other.at;
}
