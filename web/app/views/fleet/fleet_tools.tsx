import {
  IconBroadcast,
  IconPackageExport,
  IconPlayerPause,
  IconPlayerPlay,
  IconPlayerStop,
  IconPlayerTrackNext,
  IconVariable,
} from '@tabler/icons-react';
import { useState } from 'react';
import { allOf, sorts } from '../../../core/fleet';
import type { Verb } from '../../../core/fleet_desk';
import { useDrives, usePart } from '../../hooks';
import { Button } from '../../parts/button';
import { FilterField } from '../../parts/filter_field';
import { kStroke } from '../../parts/icons';
import { text } from '../../text';
import { DeployForm } from './deploy_form';
import { OrderForm } from './order_form';
import { useFleetDesk, useList } from './use_fleet';
import { words } from './words';

const icon = { size: 15, stroke: kStroke, 'aria-hidden': true };

/** What is shown, in which order. */
export function FleetTools() {
  const desk = useFleetDesk();
  const list = useList();
  const count = usePart('fleet', {}, (is) => Object.keys(is?.robots ?? {}).length);
  return (
    <div className="ftools">
      <FilterField
        name="fleet"
        label={words.find}
        value={desk.query}
        onChange={(query) => desk.set({ query })}
      />
      <label className="ftools__sort">
        {words.sort}
        <select
          className="field field--ui"
          value={desk.sort}
          onChange={(event) =>
            desk.set({ sort: sorts.find((one) => one === event.target.value) ?? 'name' })
          }
        >
          {sorts.map((one) => (
            <option key={one} value={one}>
              {words.sorts[one]}
            </option>
          ))}
        </select>
      </label>
      <span className="muted num" role="status">
        {words.shown(list.length, count)}
      </span>
    </div>
  );
}

const plain: readonly [Exclude<Verb, 'set' | 'emit' | 'raise'>, typeof IconPlayerStop][] = [
  ['stop', IconPlayerStop],
  ['pause', IconPlayerPause],
  ['continue', IconPlayerTrackNext],
  ['start', IconPlayerPlay],
];

/** Orders for the chosen robots. An observer may only stop them. */
export function FleetOrders() {
  const desk = useFleetDesk();
  const list = useList();
  const drives = useDrives();
  const [form, setForm] = useState<'emit' | 'set' | 'deploy' | null>(null);
  const chosen = [...desk.choice.chosen];
  const shown = new Set(list);
  const hidden = chosen.filter((name) => !shown.has(name)).length;
  const whyNot = (verb: Verb) =>
    chosen.length === 0
      ? words.chooseFirst
      : verb !== 'stop' && !drives
        ? text.whyNot.viewOnly
        : '';
  const toggle = (verb: 'emit' | 'set' | 'deploy') => setForm(form === verb ? null : verb);
  return (
    <div className="forders" role="group" aria-label={words.orders} data-region="orders">
      <span className="forders__count num" role="status">
        {words.chosen(chosen.length)}
        {hidden > 0 ? <span className="is-warning"> ({words.chosenHidden(hidden)})</span> : null}
      </span>
      <Button
        kind="plain"
        keys="Ctrl+A"
        onClick={() => desk.set({ choice: allOf(desk.choice, list) })}
      >
        {words.chooseAll}
      </Button>
      {chosen.length > 0 ? (
        <Button kind="plain" onClick={() => desk.set({ choice: allOf(desk.choice, []) })}>
          {words.chooseNone}
        </Button>
      ) : null}
      <span className="forders__line" />
      {plain.map(([verb, Icon]) => (
        <Order key={verb} why={whyNot(verb)} act={() => void desk.order(verb, chosen)}>
          <Icon {...icon} className={verb === 'stop' ? 'is-stop' : ''} />
          {words.verbs[verb]}
        </Order>
      ))}
      <Order why={whyNot('emit')} isOpen={form === 'emit'} act={() => toggle('emit')}>
        <IconBroadcast {...icon} />
        {words.verbs.emit}…
      </Order>
      <Order why={whyNot('set')} isOpen={form === 'set'} act={() => toggle('set')}>
        <IconVariable {...icon} />
        {words.verbs.set}…
      </Order>
      <Order
        why={drives ? '' : text.whyNot.viewOnly}
        isOpen={form === 'deploy'}
        act={() => toggle('deploy')}
      >
        <IconPackageExport {...icon} />
        {words.deploy.button}…
      </Order>
      {form === 'deploy' ? <DeployForm onClose={() => setForm(null)} /> : null}
      {form === 'emit' || form === 'set' ? (
        <OrderForm key={form} verb={form} onClose={() => setForm(null)} />
      ) : null}
    </div>
  );
}

/** A button that says why it does nothing now, and can be reached all the same. */
function Order(props: { why: string; isOpen?: boolean; act(): void; children: React.ReactNode }) {
  const { why, isOpen, act, children } = props;
  return (
    <Button
      aria-disabled={why !== ''}
      aria-expanded={isOpen}
      className={isOpen ? 'is-on' : ''}
      {...(why === '' ? {} : { tip: why })}
      onClick={() => (why === '' ? act() : undefined)}
    >
      {children}
    </Button>
  );
}
