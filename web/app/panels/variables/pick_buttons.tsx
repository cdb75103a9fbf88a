import {
  IconChartLine,
  IconEyeMinus,
  IconEyePlus,
  IconHelpCircle,
  IconX,
} from '@tabler/icons-react';
import { pickKey, pickName, type Pick } from '../../../core/picks';
import { sourceKey } from '../../../core/plot';
import { askWhyOf } from '../../commands/ask_why';
import { plotPick } from '../../commands/robot_commands';
import { useChanges, useStudio } from '../../hooks';
import { kStroke } from '../../parts/icons';
import { text } from '../../text';

const words = text.variables;
const icon = { size: 14, stroke: kStroke, 'aria-hidden': true } as const;

/** Into a plot, into the watch table, with one click; a second one takes it out again. */
export function PickButtons({
  pick,
  size,
  inWatch,
}: {
  pick: Pick;
  size: number;
  inWatch?: boolean | undefined;
}) {
  const studio = useStudio();
  useChanges(studio.watched.changed);
  useChanges(studio.plotter.changed);
  const watched = studio.watched.has(pick);
  const key = pickKey(pick);
  const plotted = studio.plotter.state.curves.some(({ source }) => {
    const own = sourceKey(source);
    return own === key || (pick.index === undefined && own.startsWith(`${key}[`));
  });
  const Eye = inWatch ? IconX : watched ? IconEyeMinus : IconEyePlus;
  const watchWord = watched ? words.unwatch(pickName(pick)) : words.watch(pickName(pick));
  const plotWord = plotted ? words.unplot(pickName(pick)) : words.plot(pickName(pick));
  return (
    <span className="variable__tools">
      <button
        type="button"
        className="tool tool--later"
        tabIndex={-1}
        aria-label={text.why.row(pick.name)}
        aria-keyshortcuts="W"
        title={`${text.why.row(pick.name)}  (W)`}
        onClick={() => askWhyOf(studio, pick)}
      >
        <IconHelpCircle {...icon} />
      </button>
      <button
        type="button"
        className={watched && !inWatch ? 'tool is-on' : 'tool tool--later'}
        tabIndex={-1}
        aria-pressed={inWatch ? undefined : watched}
        aria-label={watchWord}
        title={watchWord}
        onClick={() => studio.watched.toggle(pick)}
      >
        <Eye {...icon} />
      </button>
      <button
        type="button"
        className={plotted ? 'tool is-on' : 'tool'}
        tabIndex={-1}
        aria-pressed={plotted}
        aria-label={plotWord}
        title={plotWord}
        onClick={() => plotPick(studio, pick, size)}
      >
        <IconChartLine {...icon} />
      </button>
    </span>
  );
}
