import { memo, useContext } from 'react';
import type { Side } from '../../../../core/plan/route';
import { drawWords } from '../words';
import { BreakDot } from './break_dots';
import { ConnectContext } from './use_connecting';

export interface RowData {
  id: string;
  outcome: string;
  target: string | null;
  side: Side;
  /** Middle of the row below the top of its element. */
  y: number;
}

/** A state or event: its name at the side where its arrow starts. */
export const Row = memo(function Row(props: RowData & { source: string }) {
  const { id, outcome, target, side, y, source } = props;
  const classes = ['prow', `prow--${side}`];
  if (target === null) classes.push('is-loose');
  return (
    <div className={classes.join(' ')} style={{ top: y - 11 }} title={outcome} data-plan-row={id}>
      <BreakDot at={id} />
      <span className="ellipsis">{outcome}</span>
      <Port id={id} source={source} outcome={outcome} side={side} leads={target} y={11} />
    </div>
  );
});

/** Where an arrow starts: drag it to a target, or press Enter and choose one. */
export function Port(props: {
  id: string;
  source: string;
  outcome: string;
  side: Side;
  leads: string | null;
  y: number;
}) {
  const { id, source, outcome, side, leads, y } = props;
  const connect = useContext(ConnectContext);
  const name = outcome === '' ? drawWords.start : outcome;
  const label = leads === null ? drawWords.loosePort(name) : drawWords.port(name, leads);
  return (
    <button
      type="button"
      className={`pport pport--${side} nodrag nopan`}
      style={{ top: y - 9 }}
      aria-label={label}
      title={drawWords.portHelp}
      data-plan-port={id}
      disabled={connect === null}
      onPointerDown={(event) => connect?.begin(event, { id, source, outcome })}
      onKeyDown={(event) => {
        const { key, altKey, ctrlKey, metaKey } = event;
        // With Alt it is the key that fixes the next problem.
        if ((key !== 'Enter' && key !== ' ') || altKey || ctrlKey || metaKey) return;
        event.preventDefault();
        event.stopPropagation();
        connect?.ask({ id, source, outcome }, event.currentTarget);
      }}
    />
  );
}
