import { placeIn, ticksOf } from '../../../core/timeline';
import type { LaneView } from './lane_view';

/** Lines of the ruler; hatched what was later than the instant that is shown, and what is not kept. */
export function Background(props: {
  view: LaneView;
  height: number;
  looksBack: boolean;
  start: number;
}) {
  const { view, height, looksBack, start } = props;
  const { span, width, at, end } = view;
  const place = (t: number) => Math.min(Math.max(placeIn(span, t, width), 0), width);
  const hatched = looksBack ? [[at, end] as const] : [];
  if (start > span.from) hatched.push([span.from, start]);
  return (
    <>
      <defs>
        <pattern
          id="tl-hatch"
          width="8"
          height="8"
          patternUnits="userSpaceOnUse"
          patternTransform="rotate(-45)"
        >
          <path d="M0 0V8" className="tl__hatch" />
        </pattern>
      </defs>
      {ticksOf(span, width).map((tick) => (
        <path key={tick} d={`M${place(tick).toFixed(1)} 0V${height}`} className="tl__line" />
      ))}
      {hatched.map(([from, to]) => (
        <rect
          key={from}
          x={place(from)}
          width={place(to) - place(from)}
          height={height}
          fill="url(#tl-hatch)"
        />
      ))}
    </>
  );
}
