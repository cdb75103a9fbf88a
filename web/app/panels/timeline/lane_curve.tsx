import { curvePath, placeIn } from '../../../core/timeline';
import { text } from '../../text';
import type { LaneView } from './lane_view';
import type { HistoryCurve } from './rows';

/** A word over time, or the load that a node puts on the bus. */
export function Curve(props: {
  curve: HistoryCurve;
  view: LaneView;
  height: number;
  load: boolean;
}) {
  const { curve, view, height, load } = props;
  const { span, answered, width } = view;
  const high = listOf(curve.high);
  const low = curve.low === undefined ? high : listOf(curve.low);
  const step = (answered.to - answered.from) / Math.max(high.length, 1);
  const path = curvePath(low, high, height, (column) =>
    placeIn(span, answered.from + column * step, width),
  );
  if (!path)
    return (
      <text x={6} y={height / 2 + 8} className="tl__quiet">
        {text.past.notRecorded}
      </text>
    );
  const top = load ? `${(path.most / 100).toFixed(1)} %` : String(path.most);
  return (
    <g transform="translate(0 4)">
      <path d={path.line} className={load ? 'tl__load' : 'tl__curve'}>
        <title>{top}</title>
      </path>
    </g>
  );
}

function listOf(json: unknown): readonly unknown[] {
  return Array.isArray(json) ? json : [];
}
