import { shortCount, shownRate } from '../../../core/numbers';
import { addToPlot } from '../../commands/robot_commands';
import { useStudio, useWindow } from '../../hooks';
import { words } from './words';
import { NetworkPart, type Column } from './network_part';
import type { NetworkState } from './use_network';
import { eventWords } from '../events/words';

const { columns } = words;
const kRowsMax = 200;
const kNamesMax = 4;

const kTrafficColumns: readonly Column[] = [
  { title: columns.from },
  { title: columns.event },
  { title: columns.to },
  { title: columns.rate, is: 'number' },
  { title: columns.count, is: 'number' },
];
const kLinkColumns: readonly Column[] = [
  { title: columns.link },
  { title: columns.nodesOf },
  { title: columns.in, is: 'number' },
  { title: columns.out, is: 'number' },
  { title: columns.lost, is: 'number' },
];

/** Each event with who says it and whose scripts have a handler for it; of the chosen nodes if some are. */
export function TrafficTable({ network }: { network: NetworkState }) {
  const chosen = useWindow((state) => state.chosenNodes);
  const own = network.traffic.filter(
    ({ from, to }) =>
      chosen.length === 0 || chosen.includes(from) || to.some((node) => chosen.includes(node)),
  );
  const rows = [...own].sort(
    (a, b) =>
      network.rateOf(b) - network.rateOf(a) || b.count - a.count || (a.event < b.event ? -1 : 1),
  );
  return (
    <NetworkPart
      title={words.talk}
      count={rows.length}
      empty={words.noTraffic}
      columns={kTrafficColumns}
    >
      {rows.slice(0, kRowsMax).map((one) => (
        <tr key={`${one.from} ${one.event}`}>
          <td>{network.nameOf(one.from)}</td>
          <th scope="row">
            <EventName event={one.event} />
          </th>
          <td className="muted">
            <To names={one.to.map(network.nameOf)} />
          </td>
          <td className="table__num num">{shownRate(network.rateOf(one))}</td>
          <td className="table__num num">{shortCount(one.count)}</td>
        </tr>
      ))}
    </NetworkPart>
  );
}

/** Plots its first argument. */
function EventName({ event }: { event: string }) {
  const studio = useStudio();
  return (
    <button
      type="button"
      className="link link--event"
      title={eventWords.plot(event)}
      onClick={() => addToPlot(studio, [{ is: 'argument', event, index: 0 }])}
    >
      <code>{event}</code>
    </button>
  );
}

function To({ names }: { names: readonly string[] }) {
  if (names.length === 0) return words.nobody;
  const shown = names.slice(0, kNamesMax).join(', ');
  const more = names.length - kNamesMax;
  return <span title={names.join(', ')}>{more > 0 ? `${shown} ${words.more(more)}` : shown}</span>;
}

/** The connections of the bus, with their frames and losses. */
export function LinkTable({ network: { links, nameOf } }: { network: NetworkState }) {
  if (links.length === 0) return null;
  return (
    <NetworkPart title={words.links} count={links.length} columns={kLinkColumns}>
      {links.map((link) => (
        <tr key={link.name}>
          <th scope="row">{link.name}</th>
          <td className="muted">
            <To names={link.nodes.map(nameOf)} />
          </td>
          <td className="table__num num">{shortCount(link.frames_in)}</td>
          <td className="table__num num">{shortCount(link.frames_out)}</td>
          <td className={link.lost > 0 ? 'table__num num is-warning' : 'table__num num'}>
            {shortCount(link.lost)}
          </td>
        </tr>
      ))}
    </NetworkPart>
  );
}
