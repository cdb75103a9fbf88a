import { IconPlugConnectedX } from '@tabler/icons-react';
import { useEffect } from 'react';
import { fleetDesk } from '../../../core/fleet_desk';
import { useLink, usePart, useStudio } from '../../hooks';
import { kStroke } from '../../parts/icons';
import { FleetEvents } from './fleet_events';
import { FleetGrid } from './fleet_grid';
import { FleetHead } from './fleet_head';
import { FleetReport } from './fleet_report';
import { FleetOrders, FleetTools } from './fleet_tools';
import { RolloutPanel } from './rollout_panel';
import { text } from '../../text';
import { words } from './words';
import '../../look/fleet.css';
import '../../look/robot.css';

/** Many robots at a glance: what each does, what they are told, what happened. */
export default function FleetPage() {
  const studio = useStudio();
  const target = usePart('fleet', {}, (is) => is?.target ?? '');
  useEffect(() => fleetDesk(studio).enter(target), [studio, target]);
  useFleetKeys();
  return (
    <main className="fleet" aria-label={words.region}>
      <div className="fleet__top">
        <FleetHead />
        <BrokerNotice />
        <FleetReport />
        <FleetTools />
        <FleetOrders />
        <RolloutPanel />
      </div>
      <div className="fleet__tiles" data-region="tiles">
        <FleetGrid />
      </div>
      <FleetEvents />
    </main>
  );
}

/** The key that stops everything means the fleet here, and the robot of the project that is open beside it. */
function useFleetKeys(): void {
  const studio = useStudio();
  useEffect(
    () =>
      studio.registry.add([
        {
          id: 'fleet.stop',
          title: words.stopAllLong,
          group: text.groups.run,
          keys: ['Shift+F5'],
          async run() {
            const hasProject = studio.topics.get('studio', {})?.project !== undefined;
            const own = hasProject ? studio.stopping.press() : undefined;
            await fleetDesk(studio).order('stop', null);
            await own;
          },
        },
        {
          id: 'fleet.find',
          title: words.findRobots,
          group: text.groups.go,
          keys: ['/', 'Ctrl+F'],
          run: () => document.querySelector<HTMLElement>('[data-find="fleet"]')?.focus(),
        },
      ]),
    [studio],
  );
}

function BrokerNotice() {
  const link = useLink();
  const state = usePart('fleet', {}, (is) => is?.state);
  const why = usePart('fleet', {}, (is) => is?.why);
  const target = usePart('fleet', {}, (is) => is?.target ?? '');
  const icon = <IconPlugConnectedX className="icon" size={14} stroke={kStroke} aria-hidden />;
  const isLost = state === 'lost';
  if (link.state !== 'open')
    return (
      <div className="notice" role="status">
        {icon}
        {words.link.page}
      </div>
    );
  if (state === undefined || state === 'connected' || state === 'none') return null;
  return (
    <div className={why ? 'notice notice--error' : 'notice'} role="status">
      {icon}
      <span className="freport">
        {isLost ? words.link.lost : words.link.connecting(target)} {why}
      </span>
    </div>
  );
}
