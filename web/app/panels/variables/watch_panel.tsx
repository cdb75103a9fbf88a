import { useRef, useState, type DragEvent } from 'react';
import type { Json, Node } from '../../../protocol/messages';
import type { NumberForm } from '../../../core/numbers';
import {
  asPick,
  kPlanNode,
  moved,
  pickKey,
  pickName,
  placeOf,
  type Pick,
} from '../../../core/picks';
import { askWhyOf, isWhyKey } from '../../commands/ask_why';
import { useStudio, useTopic } from '../../hooks';
import { Quiet } from '../../parts/blank';
import { VirtualRows } from '../../parts/virtual_rows';
import { useNodeWord, usePicks, useShown, useVariablesOf } from '../../robot_hooks';
import { text } from '../../text';
import { FormButton } from './form_button';
import { Missing } from './missing_line';
import { kDragType, VariableLine } from './variable_line';
import { PickForm } from './pick_form';
import { PlanLine } from './plan_line';
import '../../look/robot.css';

const words = text.variables;

type Row = { is: 'node'; key: string; node: Node | undefined; id: number } | WatchedRow;
interface WatchedRow {
  is: 'pick';
  key: string;
  pick: Pick;
}

/** Variables picked from all nodes, side by side. While a node is paused: what changed since it was paused last. */
export default function WatchPanel() {
  const studio = useStudio();
  const frame = useRef<HTMLDivElement>(null);
  const shown = useShown(frame);
  const picks = usePicks(studio.watched);
  const nodes = useTopic('robot', {})?.nodes ?? [];
  const [form, setForm] = useState<NumberForm>('decimal');
  const [over, setOver] = useState(false);
  const drop = (event: DragEvent) => {
    setOver(false);
    const pick = droppedPick(event);
    if (pick && !studio.watched.has(pick)) studio.watched.toggle(pick);
  };
  return (
    <div
      className={over ? 'variables is-over' : 'variables'}
      ref={frame}
      onDragOver={(event) => takesPick(event) && setOver(true)}
      onDragLeave={() => setOver(false)}
      onDrop={drop}
    >
      <div className="strip-bar">
        <PickForm
          label={words.watchName}
          find="watch"
          onPick={(pick) => studio.watched.has(pick) || studio.watched.toggle(pick)}
        />
        <FormButton form={form} onChange={setForm} />
      </div>
      {picks.length === 0 ? <Quiet>{text.empty.watch}</Quiet> : null}
      {shown && picks.length > 0 ? <Rows rows={rowsOf(picks, nodes)} form={form} /> : null}
    </div>
  );
}

function Rows({ rows, form }: { rows: readonly Row[]; form: NumberForm }) {
  const studio = useStudio();
  const picked = new Set(rows.flatMap((row) => (row.is === 'pick' ? [row.pick.node] : [])));
  const ids = [...picked].filter((id) => id !== kPlanNode);
  const described = useVariablesOf(ids);
  return (
    <VirtualRows
      rows={rows}
      label={text.panels.watch}
      keyOf={(row) => row.key}
      onRowKey={(row, event) => {
        if (row.is !== 'pick') return;
        const by = event.altKey ? { ArrowUp: -1, ArrowDown: 1 }[event.key] : undefined;
        if (isWhyKey(event)) askWhyOf(studio, row.pick);
        else if (event.key === 'Delete') studio.watched.toggle(row.pick);
        else if (by) studio.watched.set(moved(studio.watched.list, row.pick, by));
        else return;
        event.preventDefault();
      }}
    >
      {(row) => {
        if (row.is === 'node') return <NodeHead row={row} />;
        if (row.pick.node === kPlanNode) return <PlanLine pick={row.pick} />;
        const place = placeOf(row.pick, described.get(row.pick.node) ?? []);
        if (!place) return <Missing pick={row.pick} known={described.has(row.pick.node)} />;
        return (
          <VariableLine
            pick={row.pick}
            place={{ node: row.pick.node, ...place }}
            form={form}
            name={pickName(row.pick)}
            inWatch
          />
        );
      }}
    </VirtualRows>
  );
}

function NodeHead({ row }: { row: Extract<Row, { is: 'node' }> }) {
  const wordOf = useNodeWord();
  if (row.id === kPlanNode) return <div className="variables__node">{words.ofPlan}</div>;
  return (
    <div className="variables__node">
      <span className="ellipsis">{row.node?.name ?? row.id}</span>
      <span className="grow" />
      <span className="variables__state">{wordOf(row.node?.state ?? 'gone')}</span>
    </div>
  );
}

function rowsOf(picks: readonly Pick[], nodes: readonly Node[]): Row[] {
  const ids = [...new Set(picks.map((pick) => pick.node))];
  return ids.flatMap((id): Row[] => [
    { is: 'node', key: `node ${id}`, id, node: nodes.find((node) => node.id === id) },
    ...picks
      .filter((pick) => pick.node === id)
      .map((pick): Row => ({ is: 'pick', key: pickKey(pick), pick })),
  ]);
}

export function takesPick(event: DragEvent): boolean {
  if (!event.dataTransfer.types.includes(kDragType)) return false;
  event.preventDefault();
  return true;
}

export function droppedPick(event: DragEvent): Pick | null {
  event.preventDefault();
  try {
    return asPick(JSON.parse(event.dataTransfer.getData(kDragType)) as Json);
  } catch {
    return null;
  }
}
