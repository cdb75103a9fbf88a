import { memo, useEffect, useMemo } from 'react';
import { eventKinds, type EventFilter } from '../../../core/fleet_desk';
import type { FleetEvent } from '../../../protocol/messages';
import { useChanges } from '../../hooks';
import { Quiet } from '../../parts/blank';
import { FilterField } from '../../parts/filter_field';
import { timeOf } from '../../parts/time_of';
import { VirtualRows } from '../../parts/virtual_rows';
import { useFleetDesk } from './use_fleet';
import { words } from './words';

const said = words.events;

/** What happened in the fleet, the newest first. */
export function FleetEvents() {
  const desk = useFleetDesk();
  useEffect(() => desk.follow(), [desk]);
  useChanges(desk.eventsChanged);
  const { events, filter } = desk;
  const { chosen } = desk.choice;
  const test = useMemo(() => passes(filter, chosen), [filter, chosen]);
  const items = useMemo(() => events.filter(test).toReversed(), [events, test]);
  return (
    <section className="fevents" data-region="events" aria-label={said.title}>
      <header className="fevents__head">
        <h2>{said.title}</h2>
        <span className="muted num">{said.shown(items.length, events.length)}</span>
        <span className="grow" />
        {desk.leftOut > 0 ? (
          <span className="is-warning num" title={said.leftOutHelp}>
            {said.leftOut(desk.leftOut)}
          </span>
        ) : null}
      </header>
      <EventTools />
      {items.length === 0 ? (
        <Quiet>{events.length === 0 ? said.none : said.noMatch}</Quiet>
      ) : (
        <VirtualRows
          rows={items}
          label={said.label}
          keyOf={(item) => item.number}
          newestFirst
          className="fevents__list"
        >
          {(item) => <EventRow item={item} />}
        </VirtualRows>
      )}
    </section>
  );
}

function EventTools() {
  const desk = useFleetDesk();
  const { filter } = desk;
  const change = (part: Partial<EventFilter>) => desk.set({ filter: { ...filter, ...part } });
  return (
    <div className="fevents__tools">
      <FilterField
        name="fleet-events"
        label={said.find}
        value={filter.find}
        onChange={(find) => change({ find })}
      />
      <div className="fevents__kinds" role="group" aria-label={said.kinds}>
        {eventKinds.map((kind) => (
          <label key={kind} className="form__check">
            <input
              type="checkbox"
              checked={filter.kinds.includes(kind)}
              onChange={() =>
                change({
                  kinds: eventKinds.filter((one) => (one === kind) !== filter.kinds.includes(one)),
                })
              }
            />
            {said.kind[kind]}
          </label>
        ))}
        <label className="form__check">
          <input
            type="checkbox"
            checked={filter.chosen}
            onChange={() => change({ chosen: !filter.chosen })}
          />
          {said.chosen}
        </label>
      </div>
    </div>
  );
}

const EventRow = memo(function EventRow({ item }: { item: FleetEvent }) {
  const { kind, name, robot, args } = item;
  const what =
    kind === 'order' ? `${verbOf(name)}: ${item.text}` : kind === 'connection' ? name : '';
  return (
    <div className={`fevent fevent--${kind}`}>
      <time className="num">{timeOf(item.wall)}</time>
      <span className="fevent__robot ellipsis">{robot}</span>
      {kind === 'event' ? (
        <code className="ellipsis" title={`${name} [${args.join(', ')}]`}>
          {name} <span className="muted">[{args.join(', ')}]</span>
        </code>
      ) : (
        <span className="ellipsis" title={what}>
          {what}
        </span>
      )}
    </div>
  );
});

function verbOf(name: string): string {
  const verbs: Partial<Record<string, string>> = words.verbs;
  return verbs[name] ?? name;
}

function passes(filter: EventFilter, chosen: ReadonlySet<string>): (item: FleetEvent) => boolean {
  const find = filter.find.trim().toLowerCase();
  return ({ kind, robot, name, text }) =>
    filter.kinds.includes(kind) &&
    (!filter.chosen || chosen.has(robot)) &&
    (find === '' || `${robot}\n${name}\n${text}`.toLowerCase().includes(find));
}
