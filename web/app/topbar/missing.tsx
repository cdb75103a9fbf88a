import { IconAlertTriangle } from '@tabler/icons-react';
import { update } from '../../core/window_state';
import { missingFor, type Missing as What } from '../../core/run_choice';
import { useStudio, useTopic } from '../hooks';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { text } from '../text';

const words = text.target.missing;

/** Beside the target: what it lacks for a run; pressing it leads to where it is fixed. */
export function Missing() {
  const studio = useStudio();
  const project = useTopic('studio', {})?.project;
  const missing = missingFor(useTopic('robot', {}), project);
  if (!project || missing === null) return null;
  const act: Record<What, () => void> = {
    project: () => void studio.registry.run('project.make'),
    target: () => update(studio.window, (draft) => void (draft.targets = true)),
    node: () => update(studio.window, (draft) => void (draft.targets = true)),
    robot: () => void studio.registry.run('world.open'),
  };
  return (
    <Button
      small
      className="missing"
      icon={<IconAlertTriangle size={14} stroke={kStroke} />}
      tip={words.help[missing]}
      onClick={act[missing]}
    >
      {words[missing]}
    </Button>
  );
}
