import {
  IconDeviceFloppy,
  IconPlayerPause,
  IconPlayerPlay,
  IconPlayerSkipForward,
  IconPlayerStop,
  IconRefresh,
  IconUpload,
  type TablerIcon,
} from '@tabler/icons-react';
import type { NodeId } from '../../../protocol/messages';
import { nodeActs, orderNodes, type NodeAct } from '../../commands/run_commands';
import { useStudio } from '../../hooks';
import { useMayAct } from '../../past_hooks';
import { kStroke } from '../../parts/icons';
import { words } from './words';

const icons: Record<NodeAct, TablerIcon> = {
  run: IconPlayerPlay,
  pause: IconPlayerPause,
  step: IconPlayerSkipForward,
  stop: IconPlayerStop,
  reset: IconRefresh,
  load: IconUpload,
  save: IconDeviceFloppy,
};
const names: Record<NodeAct, string> = { ...words, load: words.load_, save: words.save };

/** Run, pause, step, stop, reset, upload, keep: of some nodes, or of all if none is named. */
export function NodeControls({
  nodes,
  name,
  can = () => true,
}: {
  nodes: readonly NodeId[];
  name: string;
  can?(act: NodeAct): boolean;
}) {
  const studio = useStudio();
  const drives = useMayAct();
  const order = (act: NodeAct) =>
    void orderNodes(studio, act, nodes).catch((problem: unknown) => studio.tell(problem));
  return (
    <span className="controls" role="group" aria-label={words.of(words.columns.controls, name)}>
      {nodeActs.map((act) => {
        const Icon = icons[act];
        return (
          <button
            key={act}
            type="button"
            className={`tool tool--${act}`}
            disabled={!drives || !can(act)}
            aria-label={words.of(names[act], name)}
            title={words.of(names[act], name)}
            onClick={() => order(act)}
          >
            <Icon size={14} stroke={kStroke} aria-hidden />
          </button>
        );
      })}
    </span>
  );
}
