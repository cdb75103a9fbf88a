import { IconBolt, IconEye, IconEyeClosed, IconFlag } from '@tabler/icons-react';
import { memo } from 'react';
import type { NodeProps } from '@xyflow/react';
import { arrowId, supervisorKey } from '../../../../core/plan/arrows';
import { kStart } from '../../../../core/plan/model';
import { kStroke } from '../../../parts/icons';
import { drawWords as words } from '../words';
import { BreakDot } from './break_dots';
import { useFar } from './distance';
import type { ActorNode, StartNode, SupervisorNode } from './flow_nodes';
import { useLive } from './live_store';
import { Humps } from './humps';
import { Mark } from './mark';
import { NoteCard } from './note';
import { Port, Row } from './port';
import { Pill, Tag } from './small_nodes';
import { TemplateIcon } from './template_icon';

export const Start = memo(function Start({ data, selected }: NodeProps<StartNode>) {
  return (
    <div className={selected ? 'pstart is-selected' : 'pstart'}>
      <IconFlag size={14} stroke={kStroke} aria-hidden />
      {words.start}
      <Port
        id={arrowId(kStart, '')}
        source={kStart}
        outcome=""
        side={data.side}
        leads={data.leads}
        y={15}
      />
    </div>
  );
});

export const ActorBox = memo(function ActorBox({ data, selected }: NodeProps<ActorNode>) {
  const { actor, rows, findings } = data;
  const active = useLive((live) => live.actor === actor.name);
  const classes = ['pactor', `pactor--${actor.role}`];
  if (selected) classes.push('is-selected');
  if (active) classes.push('is-active');
  if (findings.errors > 0) classes.push('has-error');
  else if (findings.warnings > 0) classes.push('has-warning');
  if (useFar()) return <div className={classes.join(' ')} data-plan-actor={actor.name} />;
  return (
    <div className={classes.join(' ')} data-plan-actor={actor.name}>
      <Mark {...findings} />
      <BreakDot at={actor.name} />
      {active ? <Badge /> : null}
      <div className="pactor__head">
        <TemplateIcon icon={actor.known?.icon ?? ''} role={actor.role} />
        <div>
          <b className="ellipsis" title={actor.name}>
            <Humps name={actor.name} />
          </b>
          <span className="ellipsis">
            {actor.template}
            <Turns of={actor.name} />
          </span>
        </div>
      </div>
      {rows.map((row) => (
        <Row key={row.id} {...row} source={actor.name} />
      ))}
    </div>
  );
});

function Badge() {
  const seconds = useLive((live) => Math.max(0, live.t - live.since).toFixed(1));
  return <span className="pactor__badge num">▶ {words.seconds(seconds)}</span>;
}

/** How often it had its turn, and how long all in all. */
function Turns({ of }: { of: string }) {
  const times = useLive((live) => live.turns.get(of)?.times ?? 0);
  const seconds = useLive((live) => live.turns.get(of)?.seconds ?? 0);
  // In its first turn the badge has the time.
  const first = useLive((live) => live.actor === of && times === 1);
  if (times === 0) return null;
  if (first) return <span className="pturns num"> {words.times(times)}</span>;
  return <span className="pturns num"> {words.turns(times, seconds)}</span>;
}

export const SupervisorHexagon = memo(function SupervisorHexagon(props: NodeProps<SupervisorNode>) {
  const { data, selected } = props;
  const { supervisor, rows, findings } = data;
  const watching = useLive((live) => live.watching.has(supervisorKey(supervisor)));
  const raised = useLive((live) =>
    rows.some((row) => row.id === live.taken) ? live.takenNumber : 0,
  );
  const held = useLive((live) => live.pausedLineOf.length > 0);
  const times = useLive((live) => live.turns.get(supervisorKey(supervisor))?.times ?? 0);
  const classes = [rows.length > 1 ? 'psup psup--many' : 'psup'];
  if (selected) classes.push('is-selected');
  if (watching) classes.push('is-watching');
  if (raised > 0) classes.push('is-raised', `is-raised--${raised % 2}`);
  if (raised > 0 && held) classes.push('is-held');
  if (findings.errors > 0) classes.push('has-error');
  if (useFar()) return <div className={classes.join(' ')} data-plan-actor={supervisor.owner} />;
  const Icon = raised > 0 ? IconBolt : watching ? IconEye : IconEyeClosed;
  return (
    <div
      className={classes.join(' ')}
      data-plan-actor={supervisor.owner}
      title={`${supervisor.name}: ${supervisor.template}`}
    >
      <div className="psup__shape" />
      <Mark {...findings} />
      <BreakDot at={supervisorKey(supervisor)} />
      <Icon className="psup__eye" size={14} stroke={kStroke} aria-hidden />
      <b className="ellipsis">
        {supervisor.name}
        {times > 0 ? <span className="pturns num"> {words.times(times)}</span> : null}
      </b>
      {rows.map((row) => (
        <Row key={row.id} {...row} source={supervisorKey(supervisor)} />
      ))}
    </div>
  );
});

export const nodeTypes = {
  start: Start,
  actor: ActorBox,
  supervisor: SupervisorHexagon,
  pill: Pill,
  tag: Tag,
  note: NoteCard,
};
