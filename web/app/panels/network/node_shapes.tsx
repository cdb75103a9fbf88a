import type { Node, NodeId } from '../../../protocol/messages';
import { kBox, type Spot } from '../../../core/traffic';
import { StateMark } from '../../parts/state_sign';

interface Props {
  id: NodeId;
  spot: Spot;
  node: Node | undefined;
  name: string;
  state: string;
  chosen: boolean;
}

/** A node as a box: its sign, name, number, and its state in a word. */
export function NodeBox({ id, spot: { x, y }, node, name, state, chosen }: Props) {
  const left = x - kBox.width / 2;
  const top = y - kBox.height / 2;
  return (
    <>
      <rect
        className={`net__box net__box--${node?.state ?? 'host'}${chosen ? ' is-on' : ''}`}
        x={left}
        y={top}
        width={kBox.width}
        height={kBox.height}
        rx={node ? 8 : 20}
      />
      {node ? (
        <StateMark state={node.state} x={left + 16} y={y} />
      ) : (
        <HostMark x={left + 16} y={y} />
      )}
      <text className="net__name" x={left + 30} y={y - 3}>
        {short(name, 11)}
      </text>
      <text className="net__note" x={left + 30} y={y + 12}>
        {node ? `${id} · ${state}` : short(state, 12)}
      </text>
    </>
  );
}

/** A node as its sign, with its name outwards like a ray. */
export function NodeRay({ id, spot: { x, y, angle }, node, name, chosen }: Props) {
  const turned = Math.cos(angle) < -1e-6;
  const degrees = (angle * 180) / Math.PI + (turned ? 180 : 0);
  return (
    <>
      <circle className={chosen ? 'net__dot is-on' : 'net__dot'} cx={x} cy={y} r="8" />
      {node ? <StateMark state={node.state} x={x} y={y} /> : <HostMark x={x} y={y} />}
      <text
        className={`net__ray net__ray--${node?.state ?? 'host'}`}
        x={x}
        y={y}
        dx={turned ? -14 : 14}
        dy="4"
        textAnchor={turned ? 'end' : 'start'}
        transform={`rotate(${degrees.toFixed(2)} ${x} ${y})`}
      >
        {node ? (turned ? `${short(name, 12)} ${id}` : `${id} ${short(name, 12)}`) : name}
      </text>
    </>
  );
}

function HostMark({ x, y }: { x: number; y: number }) {
  return (
    <path className="sign sign--host" d={`M${x - 6} ${y - 5}h12v8h-12zM${x - 3} ${y + 5}h6`} />
  );
}

function short(text: string, most: number): string {
  return text.length > most ? `${text.slice(0, most - 1)}…` : text;
}
