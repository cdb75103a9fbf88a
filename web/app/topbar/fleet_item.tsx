import { IconBroadcast } from '@tabler/icons-react';
import type { FleetAddress } from '../../core/settings';
import { useDrives, useFleetName, useSettings, useStudio } from '../hooks';
import { kStroke } from '../parts/icons';
import { text } from '../text';
import { openFleet } from './open_fleet';

/** Leaves the fleet that is open, or looks again at the one that was open last. */
export function FleetItem({ onDone }: { onDone(): void }) {
  const studio = useStudio();
  const drives = useDrives();
  const name = useFleetName();
  const kept = useSettings().fleet;
  const open = async (address: FleetAddress) => {
    const why = await openFleet(studio, address);
    if (why !== '') studio.tell(new Error(why));
    onDone();
  };
  const act = () => {
    if (name === null) return void (kept && open(kept));
    studio.order('fleet.close', {});
    onDone();
  };
  if (name === null && kept === null) return null;
  return (
    <button type="button" className="menu__item" disabled={!drives} onClick={act}>
      <IconBroadcast className="icon" size={16} stroke={kStroke} aria-hidden />
      {name !== null ? text.target.leaveFleet(name) : text.target.fleet(kept?.target ?? '')}
    </button>
  );
}
