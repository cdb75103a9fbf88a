// The life of the drawing of a plot: made again when curves, axes or theme change, fitted to its place,
// drawn when samples come.

import { useEffect, useRef, type RefObject } from 'react';
import type uPlot from 'uplot';
import type { Studio } from '../../../core/studio';
import { spanWith } from '../../../core/timeline';
import { useStudio } from '../../hooks';
import { useShownTheme } from '../../robot_hooks';
import { dataOf, makeChart, pressPlot, wheelPlot, type PlotCursor } from './chart';
import { showPlot } from '../../commands/plot_handles';
import { pictureOfPlot } from './plot_picture';

export function useChart(host: RefObject<HTMLDivElement | null>, cursor: PlotCursor): void {
  const studio = useStudio();
  const { plotter, past } = studio;
  const theme = useShownTheme();
  const made = useRef<string>('');
  useEffect(() => {
    const place = host.current;
    if (!place) return;
    let plot: uPlot | null = null;
    const make = () => {
      plot?.destroy();
      plot =
        plotter.state.curves.length > 0 ? makeChart(place, plotter, cursor, () => past.at) : null;
      made.current = keyOf();
    };
    const keyOf = () => JSON.stringify(plotter.state.curves);
    const draw = () => plot?.setData(dataOf(plotter, plot.width));
    const changed = () => (made.current === keyOf() ? draw() : make());
    make();
    const observer = new ResizeObserver(() => {
      if (plot && place.clientWidth > 0)
        plot.setSize({ width: place.clientWidth, height: place.clientHeight });
    });
    observer.observe(place);
    const pressed = (event: KeyboardEvent) => {
      if (!plot || event.ctrlKey || event.altKey || event.metaKey) return;
      if (pressPlot(plot, plotter, event.key)) event.preventDefault();
    };
    const turned = (event: WheelEvent) => plot && wheelPlot(plot, plotter, event);
    place.addEventListener('keydown', pressed);
    place.addEventListener('wheel', turned, { passive: false });
    const ends = [
      plotter.drawn.on(() => plotter.held === null && draw()),
      plotter.changed.on(changed),
      past.changed.on(() => (followPast(studio), plot?.redraw())),
      showPlot(studio, () => (plot ? pictureOfPlot(plot, plotter, place) : Promise.resolve(null))),
    ];
    return () => {
      observer.disconnect();
      place.removeEventListener('keydown', pressed);
      place.removeEventListener('wheel', turned);
      ends.forEach((end) => end());
      plot?.destroy();
    };
  }, [studio, plotter, past, host, cursor, theme]);
}

/** The instant that is looked back at is in sight; now again, the newest are. */
function followPast({ past, plotter }: Studio): void {
  if (past.at === null) {
    if (plotter.held && !plotter.paused) plotter.zoom(null);
    return;
  }
  const view = plotter.view();
  const seen = spanWith(view, past.at);
  if (seen !== view || plotter.held === null) plotter.zoom(seen);
}
