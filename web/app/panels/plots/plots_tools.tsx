import { Menu } from '@mantine/core';
import {
  IconArrowBarToRight,
  IconDots,
  IconPlayerPause,
  IconPlayerPlay,
  IconTable,
} from '@tabler/icons-react';
import { spans } from '../../../core/plot';
import { update } from '../../../core/window_state';
import { useChanges, useStudio, useWindow } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { CommandItem, StudioMenu } from '../../parts/menu';
import { words } from './words';
import '../../look/robot.css';

const icon = { size: 14, stroke: kStroke };

/** At the head of the panel: how long, hold, back to the newest, as a table, save. */
export default function PlotsTools() {
  const { plotter, registry, window: store } = useStudio();
  useChanges(plotter.changed);
  const table = useWindow((state) => state.plotTable);
  const { paused, held, state } = plotter;
  const empty = state.curves.length === 0;
  const setSpan = (span: number) => {
    plotter.set({ ...state, span });
    plotter.zoom(null);
  };
  return (
    <div className="topbar__tools">
      <Button
        kind="plain"
        small
        disabled={empty || (held === null && !paused)}
        tip={words.newestHelp}
        icon={<IconArrowBarToRight {...icon} />}
        onClick={() => (plotter.pause(false), registry.run('plots.fit'))}
      />
      <select
        className="field field--small field--ui plots__span"
        aria-label={words.span}
        value={state.span}
        onChange={(event) => setSpan(Number(event.target.value))}
      >
        {spans.map((span) => (
          <option key={span} value={span}>
            {words.seconds(span)}
          </option>
        ))}
      </select>
      <Button
        kind="plain"
        small
        disabled={empty}
        tip={paused ? words.go : words.hold}
        className={paused ? 'is-on' : ''}
        aria-pressed={paused}
        icon={paused ? <IconPlayerPlay {...icon} /> : <IconPlayerPause {...icon} />}
        onClick={() => registry.run('plots.pause')}
      />
      <Button
        kind="plain"
        small
        disabled={empty}
        tip={words.table}
        className={table ? 'is-on' : ''}
        aria-pressed={table}
        icon={<IconTable {...icon} />}
        onClick={() => update(store, (draft) => void (draft.plotTable = !table))}
      />
      <StudioMenu
        position="bottom-end"
        button={<Button kind="plain" small tip={words.more} icon={<IconDots {...icon} />} />}
      >
        <CommandItem id="plots.csv" title={words.csv} />
        <CommandItem id="plots.csvFile" title={words.csvFile} />
        <CommandItem id="plots.png" title={words.png} />
        <CommandItem id="plots.pngFile" title={words.pngFile} />
        <Menu.Divider />
        <CommandItem id="plots.clear" title={words.clear} />
      </StudioMenu>
    </div>
  );
}
