import { useEffect, useRef, useState, type DragEvent } from 'react';
import { Emitter } from '../../../core/emitter';
import { plotPick } from '../../commands/robot_commands';
import { useChanges, useStudio, useWindow } from '../../hooks';
import { Quiet } from '../../parts/blank';
import { useShown } from '../../robot_hooks';
import { words } from './words';
import { PickForm } from '../variables/pick_form';
import { droppedPick, takesPick } from '../variables/watch_panel';
import type { PlotCursor } from './chart';
import { PlotLegend } from './plot_legend';
import { PlotTable } from './plot_table';
import { useChart } from './use_chart';
import 'uplot/dist/uPlot.min.css';
import '../../look/robot.css';

/** Variables and arguments of events over time. */
export default function PlotsPanel() {
  const studio = useStudio();
  const { plotter } = studio;
  const frame = useRef<HTMLDivElement>(null);
  const shown = useShown(frame);
  useChanges(plotter.changed);
  const [cursor] = useState<PlotCursor>(() => ({ time: null, moved: new Emitter() }));
  useEffect(() => (shown ? plotter.follow() : undefined), [plotter, shown]);
  const empty = plotter.state.curves.length === 0;
  const drop = (event: DragEvent) => {
    const pick = droppedPick(event);
    const variable = pick && studio.topics.get('node', { node: pick.node })?.variables;
    const size = variable?.find((one) => one.name === pick?.name)?.size ?? 1;
    if (pick) plotPick(studio, pick, pick.index === undefined ? size : 1);
  };
  return (
    <div className="plots" ref={frame} onDragOver={takesPick} onDrop={drop}>
      <div className="plots__side">
        <div className="strip-bar">
          <PickForm
            label={words.add}
            find="plots"
            onPick={(pick, size) => plotPick(studio, pick, size)}
          />
        </div>
        {empty ? <Quiet>{words.none}</Quiet> : <PlotLegend cursor={cursor} />}
      </div>
      {empty || !shown ? <div className="plots__main" /> : <Main cursor={cursor} />}
    </div>
  );
}

function Main({ cursor }: { cursor: PlotCursor }) {
  const table = useWindow((state) => state.plotTable);
  return table ? <PlotTable /> : <Chart cursor={cursor} />;
}

function Chart({ cursor }: { cursor: PlotCursor }) {
  const { plotter } = useStudio();
  const host = useRef<HTMLDivElement>(null);
  useChart(host, cursor);
  const names = plotter.state.curves.map((curve) => plotter.nameOf(curve.source)).join(', ');
  return (
    <div
      className="plots__main plots__chart"
      ref={host}
      role="img"
      aria-label={words.label(names)}
      aria-description={words.keys}
      tabIndex={0}
      data-inset
    />
  );
}
