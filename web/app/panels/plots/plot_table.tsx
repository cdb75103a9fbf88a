import { useEffect, useState } from 'react';
import { shownTime } from '../../../core/numbers';
import { sourceKey } from '../../../core/plot';
import { summaryOf } from '../../../core/plotter';
import { useStudio } from '../../hooks';
import { words } from './words';

/** Rows of the table, the newest first; and how often it is written again, so that it can be read. */
const kRows = 50;
const kEveryMs = 1000;

/** What is in sight of the plot in numbers: each curve in short, then its values. */
export function PlotTable() {
  const { plotter, world } = useStudio();
  const [, setTurn] = useState(0);
  useEffect(() => {
    let cancel = () => {};
    const turn = () => {
      setTurn((count) => count + 1);
      cancel = world.later(kEveryMs, turn);
    };
    cancel = world.later(kEveryMs, turn);
    return () => cancel();
  }, [world]);
  return (
    <div
      className="plots__main scroll"
      tabIndex={0}
      data-inset
      role="region"
      aria-label={words.table}
    >
      <Summaries />
      <Values rows={plotter.rows(kRows)} />
    </div>
  );
}

function Summaries() {
  const { plotter } = useStudio();
  const span = plotter.view();
  const { curve, now, least, most, mean } = words.head;
  return (
    <table className="table">
      <thead>
        <tr>
          <th scope="col">{curve}</th>
          {[now, least, most, mean].map((head) => (
            <th key={head} scope="col" className="table__num">
              {head}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {plotter.state.curves.map((one) => {
          const summary = summaryOf(plotter.ring(one), span);
          return (
            <tr key={sourceKey(one.source)}>
              <th scope="row">
                <code>{plotter.nameOf(one.source)}</code>
              </th>
              <td className="table__num num">{summary.last ?? '–'}</td>
              <td className="table__num num">{summary.least ?? '–'}</td>
              <td className="table__num num">{summary.most ?? '–'}</td>
              <td className="table__num num">{summary.mean?.toFixed(1) ?? '–'}</td>
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}

function Values({ rows: { head, rows } }: { rows: { head: string[]; rows: unknown[][] } }) {
  if (rows.length === 0) return <p className="quiet">{words.noSamples}</p>;
  return (
    <table className="table">
      <caption>{words.tableLabel(rows.length)}</caption>
      <thead>
        <tr>
          {head.map((name, index) => (
            <th key={name} scope="col" className="table__num">
              {index === 0 ? words.time : <code>{name}</code>}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {rows.toReversed().map((row) => (
          <tr key={String(row[0])}>
            {row.map((cell, index) =>
              index === 0 ? (
                <th key={index} scope="row" className="table__num num">
                  {shownTime(Number(cell))}
                </th>
              ) : (
                <td key={index} className="table__num num">
                  {cell === undefined ? '–' : String(cell)}
                </td>
              ),
            )}
          </tr>
        ))}
      </tbody>
    </table>
  );
}
