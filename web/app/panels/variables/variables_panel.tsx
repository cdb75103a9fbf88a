import { useMemo, useRef, useState, type KeyboardEvent } from 'react';
import {
  isOpen,
  nodeKey,
  variableKey,
  variableRows,
  type VariableRow,
} from '../../../core/variable_rows';
import type { NumberForm } from '../../../core/numbers';
import type { Studio } from '../../../core/studio';
import { askWhyOf, isWhyKey } from '../../commands/ask_why';
import { useStudio, useTopic, useWindow } from '../../hooks';
import { Quiet } from '../../parts/blank';
import { FilterField } from '../../parts/filter_field';
import { VirtualRows } from '../../parts/virtual_rows';
import { useShown, useVariablesOf } from '../../robot_hooks';
import { text } from '../../text';
import { FormButton } from './form_button';
import { Row } from './variable_row';
import '../../look/robot.css';

const words = text.variables;

/** The variables of all nodes: searched, unfolded, edited in place. Only what is seen is asked. */
export default function VariablesPanel() {
  const studio = useStudio();
  const frame = useRef<HTMLDivElement>(null);
  const shown = useShown(frame);
  const [find, setFind] = useState('');
  const [form, setForm] = useState<NumberForm>('decimal');
  const { rows, toggle } = useRows(find, shown);
  const robot = useTopic('robot', {});
  const nodes = robot?.nodes ?? [];
  return (
    <div className="variables" ref={frame}>
      {nodes.length === 0 ? (
        <Quiet>
          {robot?.kind === 'bus' ? text.empty.variablesOfBus(robot.name) : text.empty.variables}
        </Quiet>
      ) : (
        <>
          <div className="strip-bar">
            <FilterField
              name="variables"
              label={words.find}
              value={find}
              onChange={setFind}
              onKey={(event) => goOn(event, frame.current)}
            />
            <FormButton form={form} onChange={setForm} />
          </div>
          {rows.length === 0 ? <Quiet>{words.nothing(find)}</Quiet> : null}
          {/* While the panel is hidden nothing of it is drawn, and so nothing is asked. */}
          {shown ? (
            <VirtualRows
              rows={rows}
              label={text.panels.variables}
              keyOf={(row) => row.key}
              onRowKey={(row, event) => {
                if (isWhyKey(event)) askAbout(studio, row);
                else unfoldKey(row, event, toggle);
              }}
            >
              {(row) => <Row row={row} form={form} onToggle={() => toggle(row.key)} />}
            </VirtualRows>
          ) : null}
        </>
      )}
    </div>
  );
}

/** Down goes on to what was found. */
function goOn(event: KeyboardEvent<HTMLElement>, frame: HTMLElement | null): void {
  if (event.key !== 'ArrowDown') return;
  frame?.querySelector<HTMLElement>('[data-row][tabindex="0"]')?.focus();
  event.preventDefault();
}

function useRows(find: string, shown: boolean) {
  const nodes = useTopic('robot', {})?.nodes;
  const doc = useWindow((state) => state.doc);
  const [toggled, setToggled] = useState<ReadonlySet<string>>(new Set());
  const own = nodes?.find((node) => node.doc === doc)?.id ?? nodes?.[0]?.id ?? null;
  const asked = useMemo(() => ({ find, toggled, shown: own }), [find, toggled, own]);
  const described = useVariablesOf(
    shown ? (nodes ?? []).map((node) => node.id).filter((id) => isOpen(id, asked)) : [],
  );
  const rows = useMemo(
    () =>
      variableRows(
        (nodes ?? []).map((node) => ({ node, variables: described.get(node.id) })),
        asked,
      ),
    [nodes, described, asked],
  );
  const toggle = (key: string) =>
    setToggled((before) => {
      const after = new Set(before);
      if (!after.delete(key)) after.add(key);
      return after;
    });
  return { rows, toggle };
}

function askAbout(studio: Studio, row: VariableRow): void {
  if (row.is === 'variable' || row.is === 'element')
    askWhyOf(studio, { node: row.node, name: row.variable.name });
}

/**
 * Right unfolds, left folds; on what has nothing to unfold they go through its buttons. Enter does either
 * where it has no value to edit.
 */
function unfoldKey(
  row: VariableRow,
  event: KeyboardEvent<HTMLElement>,
  toggle: (key: string) => void,
): void {
  const array = row.is === 'variable' && row.variable.size > 1;
  if (row.is !== 'node' && !array) return;
  const key = row.is === 'node' ? nodeKey(row.node) : variableKey(row.node, row.variable.name);
  const wanted =
    (event.key === 'ArrowRight' && !row.open) || (event.key === 'ArrowLeft' && row.open);
  if (!wanted && (event.key !== 'Enter' || event.defaultPrevented)) return;
  event.preventDefault();
  toggle(key);
}
