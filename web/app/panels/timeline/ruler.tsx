import { useRef } from 'react';
import { shownTime } from '../../../core/numbers';
import { movedSpan, placeIn, ticksOf, timeAt } from '../../../core/timeline';
import { useStudio } from '../../hooks';
import type { LaneView } from './lane_view';
import { viewOf } from './view_store';

/** Seconds, the cursor and now, as heads over the lanes. Dragged, it moves what is in sight. */
export function Ruler({ view, looksBack }: { view: LaneView; looksBack: boolean }) {
  const studio = useStudio();
  const { span, width, at, end } = view;
  const last = useRef<number | null>(null);
  const place = (t: number) => placeIn(span, t, width);
  const inSight = (t: number) => t >= span.from && t <= span.to;
  return (
    <div
      className="tl__ruler"
      aria-hidden
      onPointerDown={(event) => {
        last.current = event.clientX;
        event.currentTarget.setPointerCapture(event.pointerId);
      }}
      onPointerMove={(event) => {
        if (last.current === null) return;
        const by = timeAt(span, last.current - event.clientX, width) - span.from;
        last.current = event.clientX;
        viewOf(studio).setState({ span: movedSpan(span, by), held: false });
      }}
      onPointerUp={() => (last.current = null)}
    >
      {ticksOf(span, width).map((tick) => (
        <span key={tick} className="tl__tick num" style={{ left: place(tick) }}>
          {tick} s
        </span>
      ))}
      {inSight(end) ? (
        <span className="tl__head tl__head--now num" style={{ left: place(end) }}>
          {end.toFixed(1)}
        </span>
      ) : null}
      {looksBack && inSight(at) ? (
        <span className="tl__head tl__head--past num" style={{ left: place(at) }}>
          {shownTime(at)}
        </span>
      ) : null}
    </div>
  );
}
