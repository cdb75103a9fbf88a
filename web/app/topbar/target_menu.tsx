import {
  IconBroadcast,
  IconChevronDown,
  IconDeviceDesktop,
  IconPlugConnected,
  IconPlugConnectedX,
  IconUsb,
} from '@tabler/icons-react';
import type { Found } from '../../protocol/messages';
import { update } from '../../core/window_state';
import { useDrives, useStudio, useTopic, useWindow } from '../hooks';
import { kStroke } from '../parts/icons';
import { StudioPopover } from '../parts/popover';
import { text } from '../text';
import { AddressForm } from './address_form';
import { FleetItem } from './fleet_item';

const icons = {
  simulator: IconDeviceDesktop,
  serial: IconUsb,
  local: IconPlugConnected,
  network: IconBroadcast,
};

/** The target, and those that can be chosen; they are looked for while the menu is open. */
export function TargetMenu() {
  const robot = useTopic('robot', {});
  const serves = useTopic('studio', {})?.serves ?? false;
  const { window: store } = useStudio();
  const open = useWindow((state) => state.targets);
  const setOpen = (next: boolean) => update(store, (draft) => void (draft.targets = next));
  const none = !robot || robot.kind === 'none';
  const Icon = none
    ? IconPlugConnectedX
    : robot.kind === 'simulator'
      ? IconDeviceDesktop
      : IconPlugConnected;
  const state =
    robot?.state === 'connecting' || robot?.state === 'lost' || robot?.state === 'failed'
      ? robot.state
      : null;
  const name = none ? text.target.none : robot.name;
  const button = (
    <button
      type="button"
      className={`btn target${state ? ` target--${state}` : ''}`}
      onClick={() => setOpen(!open)}
    >
      <Icon className="icon" size={16} stroke={kStroke} aria-hidden />
      <span className="hidden-text">{text.menu.target}</span>
      <span className="ellipsis">{name}</span>
      {state === 'connecting' ? <span className="muted">{text.target.connecting}…</span> : null}
      <IconChevronDown className="icon" size={14} stroke={kStroke} aria-hidden />
    </button>
  );
  return (
    <StudioPopover
      button={button}
      label={text.target.choose}
      position="bottom-end"
      opened={open}
      onChange={setOpen}
      width={340}
    >
      {open && serves ? <p className="quiet">{text.target.serves}</p> : null}
      {open && !serves ? (
        <TargetList why={robot?.why} connected={!none} onDone={() => setOpen(false)} />
      ) : null}
    </StudioPopover>
  );
}

function TargetList({
  why,
  connected,
  onDone,
}: {
  why: string | undefined;
  connected: boolean;
  onDone(): void;
}) {
  const studio = useStudio();
  const drives = useDrives();
  const found = (useTopic('targets', {})?.found ?? []).filter((one) => one.kind !== 'simulator');
  const choose = (target: string) => {
    studio.order('target.choose', { target });
    onDone();
  };
  return (
    <>
      {why ? <p className="quiet is-error">{why}</p> : null}
      {drives ? null : <p className="quiet">{text.whyNot.viewOnly}</p>}
      <h2 className="menu__label">{text.target.found}</h2>
      {found.length === 0 ? <p className="quiet">{text.target.nothing}</p> : null}
      {found.map((one) => (
        <button
          key={one.target}
          type="button"
          className="menu__item"
          disabled={!drives}
          onClick={() => choose(one.target)}
        >
          <TargetIcon found={one} />
          <span>
            {one.name}
            <span className="menu__help">{one.help || one.target}</span>
          </span>
        </button>
      ))}
      <button type="button" className="menu__item" disabled={!drives} onClick={() => choose('sim')}>
        <IconDeviceDesktop className="icon" size={16} stroke={kStroke} aria-hidden />
        {text.target.simulator}
      </button>
      <FleetItem onDone={onDone} />
      <hr className="menu__line" />
      <div className="menu__form">
        <AddressForm onDone={onDone} />
      </div>
      {connected ? (
        <button
          type="button"
          className="menu__item"
          disabled={!drives}
          onClick={() => (studio.order('target.leave', {}), onDone())}
        >
          <IconPlugConnectedX className="icon" size={16} stroke={kStroke} aria-hidden />
          {text.target.leave}
        </button>
      ) : null}
    </>
  );
}

export function TargetIcon({ found }: { found: Found }) {
  const Icon = icons[found.kind];
  return <Icon className="icon" size={16} stroke={kStroke} aria-hidden />;
}
