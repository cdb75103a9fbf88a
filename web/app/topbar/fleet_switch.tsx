import { update } from '../../core/window_state';
import { useFleetName, useFleetShown, useStudio } from '../hooks';
import { Segments } from '../parts/segments';
import { text } from '../text';

/** The project or the fleet, while a fleet is open. */
export function FleetSwitch({ project }: { project: string | null }) {
  const { window: store } = useStudio();
  const fleet = useFleetName();
  const isShown = useFleetShown();
  if (fleet === null) return null;
  const words = text.target;
  return (
    <Segments
      label={words.views}
      segments={[
        { value: 'project', words: project ?? text.start.title },
        { value: 'fleet', words: words.fleet(fleet) },
      ]}
      chosen={isShown ? 'fleet' : 'project'}
      onChoose={(view) =>
        update(store, (draft) => void (draft.view = view === 'fleet' ? 'fleet' : 'project'))
      }
    />
  );
}
