import { IconX } from '@tabler/icons-react';
import { useEffect, useRef } from 'react';
import {
  kAxes,
  sourceKey,
  sourceName,
  withAxis,
  withoutCurve,
  type Curve,
} from '../../../core/plot';
import { useStudio } from '../../hooks';
import { kStroke } from '../../parts/icons';
import { words } from './words';
import { dashes, type PlotCursor } from './chart';

/** The curves: line, name, axis, and the value where the cursor is, else the newest. */
export function PlotLegend({ cursor }: { cursor: PlotCursor }) {
  const { plotter } = useStudio();
  const list = useRef<HTMLUListElement>(null);
  useEffect(() => {
    const show = () => {
      const time = cursor.time ?? Math.min(plotter.view().to, plotter.newest);
      plotter.state.curves.forEach((curve, index) => {
        const place = list.current?.children[index]?.querySelector('.curve__value');
        const value = plotter.ring(curve).at(time);
        const shown = value === undefined ? '–' : String(value);
        if (place && place.textContent !== shown) place.textContent = shown;
      });
    };
    show();
    const ends = [plotter.drawn.on(show), plotter.changed.on(show), cursor.moved.on(show)];
    return () => ends.forEach((end) => end());
  }, [plotter, cursor]);
  return (
    <ul className="plots__legend" ref={list} aria-label={words.curves}>
      {plotter.state.curves.map((curve) => (
        <CurveRow key={sourceKey(curve.source)} curve={curve} />
      ))}
    </ul>
  );
}

function CurveRow({ curve: { source, axis, colour } }: { curve: Curve }) {
  const { plotter } = useStudio();
  const name = plotter.nameOf(source);
  const short = sourceName(source);
  return (
    <li className={`curve curve--${colour + 1}`}>
      <Line colour={colour} />
      <span className="curve__name ellipsis" title={name}>
        <code>{short}</code>{' '}
        {name === short ? null : (
          <span className="muted">{name.slice(0, name.length - short.length - 1)}</span>
        )}
      </span>
      <span className="curve__value num" />
      <select
        className="curve__axis num"
        aria-label={words.axis(name)}
        title={words.axis(name)}
        value={axis}
        onChange={(event) =>
          plotter.set(withAxis(plotter.state, source, Number(event.target.value)))
        }
      >
        {Array.from({ length: kAxes }, (_, index) => (
          <option key={index} value={index + 1} aria-label={words.axes(index + 1)}>
            {index + 1}
          </option>
        ))}
      </select>
      <button
        type="button"
        className="tool"
        aria-label={words.remove(name)}
        title={words.remove(name)}
        onClick={() => plotter.set(withoutCurve(plotter.state, source))}
      >
        <IconX size={12} stroke={kStroke} aria-hidden />
      </button>
    </li>
  );
}

export function Line({ colour }: { colour: number }) {
  return (
    <svg className="curve__line" viewBox="0 0 22 8" aria-hidden>
      <path d="M0 4h22" strokeDasharray={dashes[colour]?.join(' ') || undefined} />
    </svg>
  );
}
