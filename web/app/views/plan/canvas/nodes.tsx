import { IconEye, IconEyeClosed, IconFlag, IconMinus, IconSquareFilled } from '@tabler/icons-react';
import { memo } from 'react';
import type { NodeProps } from '@xyflow/react';
import { arrowId, supervisorKey } from '../../../../core/plan/arrows';
import { kStart } from '../../../../core/plan/model';
import { kStroke } from '../../../parts/icons';
import { text } from '../../../text';
import type { ActorNode, PillNode, StartNode, SupervisorNode, TagNode } from './flow_nodes';
import { useLive } from './live_store';
import { Mark } from './mark';
import { NoteCard } from './note';
import { Port, Row } from './port';
import { TemplateIcon } from './template_icon';

const words = text.draw;

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
  return (
    <div className={classes.join(' ')} data-plan-actor={actor.name}>
      <Mark {...findings} />
      {active ? <Badge /> : null}
      <div className="pactor__head">
        <TemplateIcon icon={actor.known?.icon ?? ''} role={actor.role} />
        <div>
          <b className="ellipsis" title={actor.name}>
            {actor.name}
          </b>
          <span className="ellipsis">{actor.template}</span>
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

export const SupervisorHexagon = memo(function SupervisorHexagon(props: NodeProps<SupervisorNode>) {
  const { data, selected } = props;
  const { supervisor, rows, findings } = data;
  const watching = useLive((live) => live.watching.has(supervisorKey(supervisor)));
  const raised = useLive((live) => rows.some((row) => row.id === live.taken));
  const classes = [rows.length > 1 ? 'psup psup--many' : 'psup'];
  if (selected) classes.push('is-selected');
  if (watching) classes.push('is-watching');
  if (raised) classes.push('is-raised');
  if (findings.errors > 0) classes.push('has-error');
  const Icon = watching ? IconEye : IconEyeClosed;
  return (
    <div
      className={classes.join(' ')}
      data-plan-actor={supervisor.owner}
      title={`${supervisor.name}: ${supervisor.template}`}
    >
      <div className="psup__shape" />
      <Mark {...findings} />
      <Icon className="psup__eye" size={14} stroke={kStroke} aria-hidden />
      <b className="ellipsis">{supervisor.name}</b>
      {rows.map((row) => (
        <Row key={row.id} {...row} source={supervisorKey(supervisor)} />
      ))}
    </div>
  );
});

export const Pill = memo(function Pill({ data, selected }: NodeProps<PillNode>) {
  const { variable, near } = data;
  const value = useLive((live) => live.values.get(variable.name));
  const shown = value ?? variable.initial;
  return (
    <div className={selected ? 'ppill is-selected' : near ? 'ppill is-near' : 'ppill'}>
      <b className="ellipsis">{variable.name}</b>
      <span className="num">{`${shown} ${variable.unit}`.trim()}</span>
    </div>
  );
});

export const Tag = memo(function Tag({ data }: NodeProps<TagNode>) {
  const name = data.is === 'terminate' ? words.terminate : words.ignore;
  return (
    <div className="ptag" title={name}>
      {data.is === 'terminate' ? <IconSquareFilled size={9} /> : <IconMinus size={12} stroke={2} />}
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
