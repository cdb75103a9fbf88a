import { useEffect, useMemo, useRef, useState, type RefObject } from 'react';
import { shownTime } from '../../../core/numbers';
import { useStudio, useTopic } from '../../hooks';
import { Quiet } from '../../parts/blank';
import { useEnd, usePastTime } from '../../past_hooks';
import { useShown } from '../../robot_hooks';
import { words } from './words';
import { Lanes } from './lanes';
import { LaneTable } from './lane_table';
import { rowsOf, type CurveName, type Row } from './rows';
import { Ruler } from './ruler';
import { useLanes } from './use_lanes';
import '../../look/timeline.css';

const kLabels = 148;

/** What happened when: actors, supervisors, events, curves over time, and the cursor of all panels. */
export default function TimelinePanel() {
  const frame = useRef<HTMLDivElement>(null);
  const shown = useShown(frame);
  const width = Math.max(useWidth(frame) - kLabels, 1);
  const { known, lanes, answered, span, curves } = useLanes(shown, width);
  const nodes = useTopic('robot', {})?.nodes;
  const at = usePastTime();
  const end = useEnd();
  // What is named, by its text: lists of the same are made again all the time.
  const named = JSON.stringify([curves, (nodes ?? []).map(({ id, name }) => [id, name])]);
  const rows = useMemo(() => {
    const [curves, names] = JSON.parse(named) as [CurveName[], [number, string][]];
    const nameOf = (id: number) => (id === 0 ? words.main : (new Map(names).get(id) ?? String(id)));
    return lanes ? rowsOf(lanes, curves, nameOf) : [];
  }, [lanes, named]);
  const view = { span, answered, width, at: at ?? end, end };
  return (
    <div className="tl" ref={frame}>
      {!known ? (
        <Quiet>{words.nothing}</Quiet>
      ) : (
        <>
          <Ruler view={view} looksBack={at !== null} />
          <div className="tl__scroll">
            <Labels rows={rows} />
            <Lanes rows={rows} view={view} />
          </div>
          <LaneTable rows={rows} />
          {lanes && lanes.left_out > 0 ? (
            <p className="tl__foot is-warning">{words.leftOut(lanes.left_out)}</p>
          ) : null}
        </>
      )}
      <p className="hidden-text" role="status">
        {at === null ? '' : words.at(shownTime(at))}
      </p>
    </div>
  );
}

function Labels({ rows }: { rows: readonly Row[] }) {
  return (
    <div className="tl__labels" aria-hidden>
      {rows.map((row, index) => (
        <div
          key={row.key}
          className={row.group === rows[index - 1]?.group ? 'tl__rowname' : 'tl__rowname is-first'}
          style={{ height: row.height }}
        >
          {row.group === rows[index - 1]?.group ? null : (
            <span className="tl__group">{row.group}</span>
          )}
          <span className="tl__of ellipsis" title={row.note}>
            {row.label}
            {row.note && row.is === 'curve' ? <small>{row.note}</small> : null}
          </span>
        </div>
      ))}
    </div>
  );
}

/** Of the panel, in pixels. */
function useWidth(place: RefObject<HTMLElement | null>): number {
  const { world } = useStudio();
  const [width, setWidth] = useState(0);
  useEffect(() => {
    if (!place.current) return;
    const observer = new ResizeObserver(([entry]) =>
      world.frame(() => setWidth(Math.floor(entry?.contentRect.width ?? 0))),
    );
    observer.observe(place.current);
    return () => observer.disconnect();
  }, [place, world]);
  return width;
}
