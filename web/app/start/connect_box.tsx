import { IconAntennaBarsOff, IconDeviceDesktop, IconPlugConnected } from '@tabler/icons-react';
import type { Found } from '../../protocol/messages';
import { useDrives, useStudio, useTopic } from '../hooks';
import { Blank } from '../parts/blank';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { AddressForm } from '../topbar/address_form';
import { TargetIcon } from '../topbar/target_menu';
import { startWords } from './words';

const words = startWords;

/** Targets that were found, an address, the simulator. */
export function ConnectBox() {
  const studio = useStudio();
  const drives = useDrives();
  const found = (useTopic('targets', {})?.found ?? []).filter((one) => one.kind !== 'simulator');
  return (
    <section className="box" aria-label={words.connect}>
      <div className="first__title">
        <IconPlugConnected className="icon" size={16} stroke={kStroke} aria-hidden />
        <h2>{words.connect}</h2>
      </div>
      {found.length === 0 ? (
        <Blank
          icon={<IconAntennaBarsOff className="icon" size={20} stroke={kStroke} aria-hidden />}
          title={words.noRobot}
        >
          {words.noRobotHelp}
        </Blank>
      ) : (
        found.map((one) => <FoundRow key={one.target} found={one} />)
      )}
      <AddressForm />
      <div className="box__row box__row--line">
        <IconDeviceDesktop className="icon" size={16} stroke={kStroke} aria-hidden />
        <span>
          <b>{words.simulator}</b>
          <span className="box__help">{words.simulatorHelp}</span>
        </span>
        <Button
          kind="primary"
          disabled={!drives}
          onClick={() => studio.order('target.choose', { target: 'sim' })}
        >
          {words.startButton}
        </Button>
      </div>
    </section>
  );
}

function FoundRow({ found }: { found: Found }) {
  const studio = useStudio();
  const drives = useDrives();
  return (
    <div className="box__row">
      <TargetIcon found={found} />
      <span>
        <b>{found.name}</b>
        <span className="box__help">{found.help || found.target}</span>
      </span>
      <Button
        disabled={!drives}
        aria-label={`${words.connectButton}: ${found.name}`}
        onClick={() => studio.order('target.choose', { target: found.target })}
      >
        {words.connectButton}
      </Button>
    </div>
  );
}
