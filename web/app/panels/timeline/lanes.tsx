import { useEffect, useEffectEvent, useRef, type PointerEvent } from 'react';
import { shownTime } from '../../../core/numbers';
import { movedSpan, placeIn, timeAt } from '../../../core/timeline';
import { useStudio } from '../../hooks';
import { usePastTime } from '../../past_hooks';
import { words } from './words';
import { Background } from './background';
import { LaneShapes } from './lane_marks';
import type { LaneView } from './lane_view';
import { snapped, snapsOf, type Row } from './rows';
import { showAll, viewOf, zoomBy } from './view_store';

/** The pointer means an edge or a mark that is so near. */
const kSnapPx = 4;

/** The lanes with the cursor: a slider over time. */
export function Lanes({ rows, view }: { rows: readonly Row[]; view: LaneView }) {
  const studio = useStudio();
  const { past } = studio;
  const frame = useRef<HTMLDivElement>(null);
  const at = usePastTime();
  const { span, width, end } = view;
  useWheel(frame, view);
  const point = (event: PointerEvent<HTMLElement>) => {
    if (event.buttons !== 1) return;
    event.currentTarget.setPointerCapture(event.pointerId);
    const left = event.clientX - event.currentTarget.getBoundingClientRect().left;
    const within = (kSnapPx / width) * (span.to - span.from);
    past.look(snapped(timeAt(span, left, width), snapsOf(rows), within));
  };
  const height = rows.reduce((sum, row) => sum + row.height, 0);
  return (
    <div
      className="tl__lanes"
      ref={frame}
      role="slider"
      tabIndex={0}
      data-inset
      data-autofocus
      data-place="past"
      aria-label={words.cursor}
      aria-description={words.help}
      aria-valuemin={past.start}
      aria-valuemax={end}
      aria-valuenow={at ?? end}
      aria-valuetext={at === null ? words.now : words.at(shownTime(at))}
      onPointerDown={point}
      onPointerMove={point}
    >
      <svg width={width} height={height} aria-hidden>
        <Background view={view} height={height} looksBack={at !== null} start={past.start} />
        {rows.map((row, index) => (
          <g key={row.key} transform={`translate(0 ${topOf(rows, index)})`}>
            {row.group === rows[index - 1]?.group ? null : (
              <path d={`M0 .5H${width}`} className="tl__line" />
            )}
            <LaneShapes row={row} view={view} />
          </g>
        ))}
      </svg>
      <Line view={view} t={end} kind="now" />
      {at === null ? null : <Line view={view} t={at} kind="past" />}
    </div>
  );
}

function topOf(rows: readonly Row[], index: number): number {
  return rows.slice(0, index).reduce((sum, row) => sum + row.height, 0);
}

function Line({ view, t, kind }: { view: LaneView; t: number; kind: 'now' | 'past' }) {
  const { span, width } = view;
  if (t < span.from || t > span.to) return null;
  return (
    <div className={`tl__cursor tl__cursor--${kind}`} style={{ left: placeIn(span, t, width) }} />
  );
}

/** The wheel zooms around the pointer; with Shift, or sideways, it moves. Plus, minus, Home. */
function useWheel(frame: React.RefObject<HTMLDivElement | null>, view: LaneView): void {
  const studio = useStudio();
  const turn = useEffectEvent((event: WheelEvent, left: number) => {
    const { span, width } = view;
    const sideways = event.shiftKey ? event.deltaY : event.deltaX;
    if (sideways !== 0) {
      const by = (sideways / width) * (span.to - span.from);
      viewOf(studio).setState({ span: movedSpan(span, by), held: false });
      return;
    }
    const factor = Math.exp(Math.max(-1, Math.min(1, event.deltaY / 200)));
    zoomBy(studio, factor, timeAt(span, left, width));
  });
  useEffect(() => {
    const place = frame.current;
    if (!place) return;
    const turned = (event: WheelEvent) => {
      event.preventDefault();
      turn(event, event.clientX - place.getBoundingClientRect().left);
    };
    const pressed = (event: KeyboardEvent) => {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      if (event.key === '+') zoomBy(studio, 0.5);
      else if (event.key === '-') zoomBy(studio, 2);
      else if (event.key === 'Home') showAll(studio);
      else return;
      event.preventDefault();
    };
    place.addEventListener('wheel', turned, { passive: false });
    place.addEventListener('keydown', pressed);
    return () => {
      place.removeEventListener('wheel', turned);
      place.removeEventListener('keydown', pressed);
    };
  }, [studio, frame]);
}
