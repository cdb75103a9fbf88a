import { IconChartLine } from '@tabler/icons-react';
import { useEffect } from 'react';
import { shortCount, shownRate, shownTime } from '../../../core/numbers';
import type { Count } from '../../../core/happenings';
import { addToPlot } from '../../commands/robot_commands';
import { useChanges, useStudio } from '../../hooks';
import { Quiet } from '../../parts/blank';
import { kStroke } from '../../parts/icons';
import { text } from '../../text';
import { eventWords } from './words';

const words = eventWords;

/** How often each event came, and from whom. */
export function EventCounts() {
  const { happenings } = useStudio();
  useEffect(() => happenings.follow(), [happenings]);
  useChanges(happenings.changed);
  const counts = happenings.countList();
  if (counts.length === 0) return <Quiet>{text.empty.events}</Quiet>;
  const most = counts[0]?.count ?? 1;
  return (
    <div className="scroll" tabIndex={0} data-inset role="region" aria-label={words.counts}>
      <table className="table">
        <thead>
          <tr>
            <th scope="col">{words.table.name}</th>
            <th scope="col">{words.table.source}</th>
            <th scope="col" className="table__num">
              {words.table.count}
            </th>
            <th scope="col" className="table__num">
              {words.table.rate}
            </th>
            <th scope="col" className="table__num table__wide">
              {words.table.last}
            </th>
            <td />
          </tr>
        </thead>
        <tbody>
          {counts.map((count) => (
            <Row
              key={`${count.last.kind} ${count.name} ${count.source}`}
              count={count}
              most={most}
            />
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Row({ count: { name, source, count, rate, last }, most }: { count: Count; most: number }) {
  const studio = useStudio();
  const plotted = last.kind === 'event' && last.args.length > 0;
  const plot = () =>
    addToPlot(
      studio,
      last.args.slice(0, 8).map((_, index) => ({ is: 'argument', event: name, index })),
    );
  return (
    <tr>
      <th scope="row">
        {last.kind === 'event' ? null : <b className="event__kind">{words.kindWords[last.kind]}</b>}{' '}
        <code>{name}</code>
      </th>
      <td className="muted">{source}</td>
      <td className="table__num num">
        <svg className="table__bar" viewBox="0 0 40 4" preserveAspectRatio="none" aria-hidden>
          <rect width={Math.max(1, (count / most) * 40)} height="4" rx="1" />
        </svg>
        {shortCount(count)}
      </td>
      <td className="table__num num">{shownRate(rate)}</td>
      <td className="table__num table__wide num muted">{shownTime(last.t)}</td>
      <td className="table__tools">
        {plotted ? (
          <button
            type="button"
            className="tool"
            aria-label={words.plot(name)}
            title={words.plot(name)}
            onClick={plot}
          >
            <IconChartLine size={14} stroke={kStroke} aria-hidden />
          </button>
        ) : null}
      </td>
    </tr>
  );
}
