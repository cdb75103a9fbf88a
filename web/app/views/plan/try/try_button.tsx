import { IconHandClick } from '@tabler/icons-react';
import type { Doc } from '../../../../protocol/messages';
import { tryingOf } from '../../../../core/plan/trying';
import { useChanges, useStudio } from '../../../hooks';
import { Button } from '../../../parts/button';
import { kStroke } from '../../../parts/icons';
import { tryPlan } from './try_commands';
import { tryWords as words } from './words';

export function TryButton({ doc }: { doc: Doc }) {
  const studio = useStudio();
  const trying = tryingOf(studio);
  useChanges(trying.changed);
  const isOn = trying.doc === doc;
  return (
    <Button
      kind="plain"
      small
      aria-pressed={isOn}
      aria-label={words.button}
      tip={words.tip}
      icon={<IconHandClick size={14} stroke={kStroke} />}
      onClick={() => (isOn ? trying.leave() : tryPlan(studio, doc))}
    >
      <span className="plan__word">{words.button}</span>
    </Button>
  );
}
