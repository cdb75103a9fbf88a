import {
  IconArrowBarToRight,
  IconArrowsMaximize,
  IconDeviceFloppy,
  IconTestPipe,
  IconZoomIn,
  IconZoomOut,
} from '@tabler/icons-react';
import type { Studio } from '../../../core/studio';
import { whyNot } from '../../commands/why_not';
import { useCommands, useStudio, useTopic } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { text } from '../../text';
import '../../look/timeline.css';
import { EarlierRuns } from './earlier_runs';
import { RobotChoice } from './robot_choice';
import { words } from './words';
import { followNewest, showAll, useTimelineView, zoomBy } from './view_store';

/** A button that cannot be pressed says why. */
function keepTip(studio: Studio): string {
  const title = text.commands['test.keep'];
  const keep = studio.registry.find('test.keep');
  const why = keep === undefined ? '' : whyNot(studio, keep);
  return why === '' ? title : `${title}: ${why}`;
}

const icon = { size: 14, stroke: kStroke };

/** At the head of the panel: which seconds, larger and smaller, everything, the newest, save. */
export default function TimelineTools() {
  const studio = useStudio();
  const { registry } = studio;
  useCommands();
  useTopic('plan', {});
  const { from, to } = useTimelineView((view) => view.drawn);
  const follows = useTimelineView((view) => view.span === null);
  const tools = [
    [words.larger, <IconZoomIn key="in" {...icon} />, () => zoomBy(studio, 0.5)],
    [words.smaller, <IconZoomOut key="out" {...icon} />, () => zoomBy(studio, 2)],
    [words.fit, <IconArrowsMaximize key="fit" {...icon} />, () => showAll(studio)],
  ] as const;
  return (
    <div className="topbar__tools">
      <RobotChoice />
      <span className="tl__span num">{words.span(from.toFixed(1), to.toFixed(1))}</span>
      {tools.map(([tip, sign, act]) => (
        <Button key={tip} kind="plain" small tip={tip} icon={sign} onClick={act} />
      ))}
      <Button
        kind="plain"
        small
        tip={words.follow}
        aria-pressed={follows}
        className={follows ? 'is-on' : ''}
        icon={<IconArrowBarToRight {...icon} />}
        onClick={() => followNewest(studio)}
      />
      <Button
        kind="plain"
        small
        tip={words.save}
        disabled={!registry.isEnabled('trace.save')}
        icon={<IconDeviceFloppy {...icon} />}
        onClick={() => void registry.run('trace.save')}
      />
      <Button
        kind="plain"
        small
        tip={keepTip(studio)}
        disabled={!registry.isEnabled('test.keep')}
        icon={<IconTestPipe {...icon} />}
        onClick={() => void registry.run('test.keep')}
      />
      <EarlierRuns />
    </div>
  );
}
