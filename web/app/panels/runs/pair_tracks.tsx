import type { PointerEvent } from 'react';
import { spanOf, type Compared } from '../../../core/pairing';
import type { ComparedRun } from '../../../protocol/messages';
import { useStudio } from '../../hooks';
import { lookAtBoth } from './look_at_both';
import { runWords as words } from './words';

/** Deeper sub-plans are drawn with these. */
const kLevels = 3;
/** Of the width: a narrower one has no room for a name. */
const kNameFrom = 0.06;

/** Both timelines on one axis: actors as bars, events as ticks, first differences as marks. */
export function PairTracks({ found, t }: { found: Compared; t: number }) {
  const studio = useStudio();
  const { from, to } = spanOf(found);
  const length = Math.max(to - from, 1e-3);
  const share = (at: number) => (at - from) / length;
  const point = (event: PointerEvent<HTMLElement>) => {
    if (event.buttons === 0) return;
    const { left, width } = event.currentTarget.getBoundingClientRect();
    lookAtBoth(studio, from + ((event.clientX - left) / width) * length);
  };
  const left = (at: number) => `${(share(at) * 100).toFixed(3)}%`;
  const marks = found.lanes.flatMap(({ name, t: at }) => (at === undefined ? [] : [{ name, at }]));
  return (
    <div
      className="runs__tracks"
      role="img"
      aria-label={words.tracks}
      onPointerDown={point}
      onPointerMove={point}
    >
      {(['a', 'b'] as const).map((side) => (
        <Track key={side} side={side} run={found[side]} left={left} share={share} />
      ))}
      {marks.map(({ name, at }) => (
        <i key={name} className="runs__mark" title={name} style={{ left: left(at) }} />
      ))}
      <i className="runs__cursor" style={{ left: left(t) }} />
    </div>
  );
}

function Track(props: {
  side: 'a' | 'b';
  run: ComparedRun;
  left(at: number): string;
  share(at: number): number;
}) {
  const { side, run, left, share } = props;
  const levels = [...Array(kLevels).keys()].filter((level) =>
    run.actors.some((one) => Math.min(one.level, kLevels - 1) === level),
  );
  return (
    <div className={`runs__track runs__track--${side}`}>
      <b className="runs__letter">{side.toUpperCase()}</b>
      {(levels.length > 0 ? levels : [0]).map((level) => (
        <div key={level} className="runs__level">
          {run.actors.map(({ name, level: own, from, to }, index) => {
            if (Math.min(own, kLevels - 1) !== level) return null;
            const width = share(to) - share(from);
            return (
              <span
                key={index}
                className="runs__actor"
                title={name}
                style={{ left: left(from - run.start), width: `${(width * 100).toFixed(3)}%` }}
              >
                {width > kNameFrom ? name : ''}
              </span>
            );
          })}
        </div>
      ))}
      <div className="runs__events">
        {run.events.map(({ name, supervisor, t }, index) => (
          <i key={index} title={`${supervisor}: ${name}`} style={{ left: left(t - run.start) }} />
        ))}
      </div>
      {run.more > 0 ? <p className="runs__note">{words.more(run.more)}</p> : null}
    </div>
  );
}
