import { IconX } from '@tabler/icons-react';
import {
  kRolloutRows,
  mayRollBack,
  rowsOf,
  wellIn,
  type Rollout,
  type RolloutRow,
} from '../../../core/rollout';
import { useDrives, usePart } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { text } from '../../text';
import { useFleetDesk } from './use_fleet';
import { words } from './words';

const said = words.rollout;

/** What became of the last roll-out of this fleet at each robot; every page sees the same. */
export function RolloutPanel() {
  const desk = useFleetDesk();
  const target = usePart('fleet', {}, (is) => is?.target ?? '');
  const rollout = usePart('rollout', {}, (is) => is);
  if (!rollout || rollout.state === 'none' || rollout.target !== target) return null;
  if (desk.dismissed === rollout.begun_wall && rollout.state !== 'running') return null;
  const rows = rowsOf(rollout);
  return (
    <section className="frollout" aria-label={said.title} data-region="rollout">
      <RolloutHead rollout={rollout} rows={rows} />
      {rollout.why === '' ? null : <p className="freport">{rollout.why}.</p>}
      <p className="why" role="alert">
        {desk.rolloutWhy}
      </p>
      <RolloutTable rows={rows} />
    </section>
  );
}

function RolloutHead({ rollout, rows }: { rollout: Rollout; rows: readonly RolloutRow[] }) {
  const desk = useFleetDesk();
  const drives = useDrives();
  const why = drives ? '' : text.whyNot.viewOnly;
  const isUnderWay = rollout.state === 'running';
  const lock = why === '' ? {} : { tip: why, 'aria-disabled': true };
  return (
    <div className="frollout__head">
      <strong role="status">
        {said.summary(rollout.back, rollout.version, wellIn(rows), rows.length)}
      </strong>
      <span className={rollout.state === 'failed' ? 'is-warning' : 'muted'}>
        {said.states[rollout.state]}
        {rollout.by === '' ? '' : ` · ${said.by(rollout.by)}`}
      </span>
      <span className="grow" />
      {isUnderWay ? (
        <Button small {...lock} onClick={() => (drives ? void desk.stopRollout() : undefined)}>
          {said.stop}
        </Button>
      ) : null}
      {mayRollBack(rollout) ? (
        <Button small {...lock} onClick={() => (drives ? void desk.rollBack() : undefined)}>
          {said.back}
        </Button>
      ) : null}
      {isUnderWay ? null : (
        <Button
          kind="plain"
          small
          tip={words.report.dismiss}
          icon={<IconX size={14} stroke={kStroke} />}
          onClick={() => desk.dismiss(rollout.begun_wall)}
        />
      )}
    </div>
  );
}

function RolloutTable({ rows }: { rows: readonly RolloutRow[] }) {
  const more = rows.length - kRolloutRows;
  return (
    <div className="frollout__rows" tabIndex={0} role="region" aria-label={said.table}>
      <table aria-label={said.table}>
        <thead>
          <tr>
            <th scope="col">{said.robot}</th>
            <th scope="col">{said.became}</th>
          </tr>
        </thead>
        <tbody>
          {rows.slice(0, kRolloutRows).map((row) => (
            <tr key={row.name} data-rollout={row.name} data-is={row.is}>
              <th scope="row">{row.name}</th>
              <td>{said.row(row.is, row.why)}</td>
            </tr>
          ))}
        </tbody>
      </table>
      {more > 0 ? <p className="muted">{said.more(more)}</p> : null}
    </div>
  );
}
