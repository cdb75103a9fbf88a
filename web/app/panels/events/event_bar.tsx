import { Menu } from '@mantine/core';
import {
  IconAdjustmentsHorizontal,
  IconEraser,
  IconFileTypeCsv,
  IconListNumbers,
  IconPlayerPause,
  IconPlayerPlay,
} from '@tabler/icons-react';
import { allEvents, happeningKinds, type EventFilter } from '../../../core/happenings';
import { updateEvents } from '../../../core/window_state';
import { useStudio, useTopic, useWindow } from '../../hooks';
import { Button } from '../../parts/button';
import { FilterField } from '../../parts/filter_field';
import { kStroke } from '../../parts/icons';
import { StudioMenu } from '../../parts/menu';
import { eventWords } from './words';

const words = eventWords;
const icon = { size: 14, stroke: kStroke };

/** What is listed; hold, empty, counts, save. */
export function EventBar() {
  const { window: store, registry } = useStudio();
  const { filter, paused, counts } = useWindow((state) => state.events);
  const change = (part: Partial<EventFilter>) =>
    updateEvents(store, { filter: { ...filter, ...part } });
  return (
    <div className="strip-bar">
      <FilterField
        name="events"
        label={words.find}
        value={filter.find}
        onChange={(find) => change({ find })}
      />
      <FilterMenu filter={filter} onChange={change} />
      <Button
        kind="plain"
        small
        tip={paused ? words.go : words.hold}
        className={paused ? 'is-on' : ''}
        aria-pressed={paused}
        icon={paused ? <IconPlayerPlay {...icon} /> : <IconPlayerPause {...icon} />}
        onClick={() => registry.run('events.pause')}
      />
      <Button
        kind="plain"
        small
        tip={words.counts}
        className={counts ? 'is-on' : ''}
        aria-pressed={counts}
        icon={<IconListNumbers {...icon} />}
        onClick={() => updateEvents(store, { counts: !counts })}
      />
      <Button
        kind="plain"
        small
        tip={words.csv}
        icon={<IconFileTypeCsv {...icon} />}
        onClick={() => registry.run('events.csv')}
      />
      <Button
        kind="plain"
        small
        tip={words.clear}
        icon={<IconEraser {...icon} />}
        onClick={() => registry.run('events.clear')}
      />
    </div>
  );
}

function FilterMenu({
  filter,
  onChange,
}: {
  filter: EventFilter;
  onChange(part: Partial<EventFilter>): void;
}) {
  const nodes = useTopic('robot', {})?.nodes ?? [];
  const narrowed = filter.node !== allEvents.node || filter.kinds.length !== allEvents.kinds.length;
  const toggle = (kind: (typeof happeningKinds)[number]) =>
    onChange({
      kinds: happeningKinds.filter((one) => (one === kind) !== filter.kinds.includes(one)),
    });
  const button = (
    <Button
      kind="plain"
      small
      tip={words.filter}
      className={narrowed ? 'is-on' : ''}
      icon={<IconAdjustmentsHorizontal {...icon} />}
    />
  );
  return (
    <StudioMenu button={button} position="bottom-end" closeOnItemClick={false}>
      {happeningKinds.map((kind) => (
        <Menu.Item
          key={kind}
          role="menuitemcheckbox"
          aria-checked={filter.kinds.includes(kind)}
          leftSection={<Check on={filter.kinds.includes(kind)} />}
          onClick={() => toggle(kind)}
        >
          {words.kinds[kind]}
        </Menu.Item>
      ))}
      <Menu.Divider />
      <Menu.Item
        role="menuitemradio"
        aria-checked={filter.node === null}
        leftSection={<Check on={filter.node === null} />}
        onClick={() => onChange({ node: null })}
      >
        {words.allNodes}
      </Menu.Item>
      {nodes.map((node) => (
        <Menu.Item
          key={node.id}
          role="menuitemradio"
          aria-checked={filter.node === node.id}
          leftSection={<Check on={filter.node === node.id} />}
          onClick={() => onChange({ node: node.id })}
        >
          {node.name} <span className="muted num">{node.id}</span>
        </Menu.Item>
      ))}
    </StudioMenu>
  );
}

function Check({ on }: { on: boolean }) {
  return (
    <svg className="check" viewBox="0 0 12 12" aria-hidden>
      {on ? <path d="M2.5 6.5L5 9L9.5 3.5" /> : null}
    </svg>
  );
}
