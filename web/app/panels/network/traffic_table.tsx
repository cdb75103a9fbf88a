import { shortCount, shownRate } from '../../../core/numbers';
import { addToPlot } from '../../commands/robot_commands';
import { useStudio, useWindow } from '../../hooks';
import { text } from '../../text';
import type { NetworkState } from './use_network';

const words = text.network;
const { columns } = words;
const kRowsMax = 200;
const kNamesMax = 4;

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
    <section className="network__part">
      <div className="network__head">
        <h3>{words.talk}</h3>
        <span className="count">{rows.length}</span>
      </div>
      {rows.length === 0 ? <p className="quiet">{words.noTraffic}</p> : null}
      {rows.length > 0 ? (
        <table className="table">
          <thead>
            <tr>
              <th scope="col">{columns.from}</th>
              <th scope="col">{columns.event}</th>
              <th scope="col">{columns.to}</th>
              <th scope="col" className="table__num">
                {columns.rate}
              </th>
              <th scope="col" className="table__num">
                {columns.count}
              </th>
            </tr>
          </thead>
          <tbody>
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
          </tbody>
        </table>
      ) : null}
    </section>
  );
}

/** Plots its first argument. */
function EventName({ event }: { event: string }) {
  const studio = useStudio();
  return (
    <button
      type="button"
      className="link link--event"
      title={text.events.plot(event)}
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
    <section className="network__part">
      <div className="network__head">
        <h3>{words.links}</h3>
        <span className="count">{links.length}</span>
      </div>
      <table className="table">
        <thead>
          <tr>
            <th scope="col">{columns.link}</th>
            <th scope="col">{columns.nodesOf}</th>
            <th scope="col" className="table__num">
              {columns.in}
            </th>
            <th scope="col" className="table__num">
              {columns.out}
            </th>
            <th scope="col" className="table__num">
              {columns.lost}
            </th>
          </tr>
        </thead>
        <tbody>
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
        </tbody>
      </table>
    </section>
  );
}
