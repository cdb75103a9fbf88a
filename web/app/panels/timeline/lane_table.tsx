import { shownTime } from '../../../core/numbers';
import { words } from './words';
import type { Row } from './rows';

/** So many rows; for more, look at fewer seconds. */
const kRowsMax = 200;

interface Line {
  key: string;
  from: number;
  to: number | undefined;
  what: string;
  how: string;
}

/** The lanes of actors and supervisors in words, for those who do not see them. */
export function LaneTable({ rows }: { rows: readonly Row[] }) {
  const { columns } = words;
  return (
    <table className="hidden-text">
      <caption>{words.table}</caption>
      <thead>
        <tr>
          <th scope="col">{columns.what}</th>
          <th scope="col">{columns.from}</th>
          <th scope="col">{columns.to}</th>
          <th scope="col">{columns.how}</th>
        </tr>
      </thead>
      <tbody>
        {linesOf(rows).map((line) => (
          <tr key={line.key}>
            <th scope="row">{line.what}</th>
            <td>{shownTime(line.from)}</td>
            <td>{line.to === undefined ? words.goesOn : shownTime(line.to)}</td>
            <td>{line.how}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function linesOf(rows: readonly Row[]): Line[] {
  return rows
    .flatMap((row): Line[] => {
      if (row.is === 'actors')
        return row.lane.bars.map(({ from, to, name, count, end }) => ({
          key: `${row.key} ${from}`,
          from,
          to,
          what: name ?? words.many(count ?? 1),
          how: end ?? '',
        }));
      if (row.is !== 'supervisor') return [];
      return row.lane.marks.map(({ t, name, to }) => ({
        key: `${row.key} ${t} mark`,
        from: t,
        to: t,
        what: `${row.label}: ${name ?? ''}`,
        how: to ?? '',
      }));
    })
    .sort((a, b) => a.from - b.from)
    .slice(-kRowsMax);
}
