import { IconChevronDown, IconChevronRight } from '@tabler/icons-react';
import { memo } from 'react';
import type { NumberForm } from '../../../core/numbers';
import type { VariableRow } from '../../../core/variable_rows';
import { useTopic } from '../../hooks';
import { useNodeWord } from '../../robot_hooks';
import { kStroke } from '../../parts/icons';
import { WriteScript } from '../../parts/write_script';
import { text } from '../../text';
import { VariableLine } from './variable_line';

const words = text.variables;

/** Rows that stay are not rendered again while a list is scrolled. What toggles does not change. */
export const Row = memo(VariableRowView, (a, b) => a.row === b.row && a.form === b.form);

/** One row of the list: a node, a caption, a variable, an element of an array. */
function VariableRowView({
  row,
  form,
  onToggle,
}: {
  row: VariableRow;
  form: NumberForm;
  onToggle(): void;
}) {
  switch (row.is) {
    case 'node':
      return <NodeRow row={row} onToggle={onToggle} />;
    case 'group':
      return <p className="variables__group">{words.of[row.of]}</p>;
    case 'waits':
      return <p className="variables__group">{words.waits}</p>;
    case 'variable': {
      const { node, variable, open } = row;
      return (
        <VariableLine
          pick={{ node, name: variable.name }}
          place={{ node, variable, first: variable.address, count: variable.size }}
          form={form}
          name={variable.name}
          open={open}
          onToggle={variable.size > 1 ? onToggle : undefined}
        />
      );
    }
    case 'element': {
      const { node, variable, index } = row;
      return (
        <VariableLine
          pick={{ node, name: variable.name, index }}
          place={{ node, variable, first: variable.address + index, count: 1 }}
          form={form}
          name={`[${index}]`}
        />
      );
    }
  }
}

function NodeRow({
  row,
  onToggle,
}: {
  row: Extract<VariableRow, { is: 'node' }>;
  onToggle(): void;
}) {
  const Icon = row.open ? IconChevronDown : IconChevronRight;
  const wordOf = useNodeWord();
  const node = useTopic('robot', {})?.nodes.find((one) => one.id === row.node);
  const button = (
    <button
      type="button"
      className="variables__node"
      data-inset
      tabIndex={-1}
      aria-expanded={row.open}
      onClick={onToggle}
    >
      <Icon className="icon" size={14} stroke={kStroke} aria-hidden />
      <span className="ellipsis">{row.name}</span>
      <span className="muted num">{row.node}</span>
      <span className="grow" />
      <span className="variables__state">{wordOf(row.state)}</span>
    </button>
  );
  if (!node || node.doc || node.state === 'gone') return button;
  return (
    <div className="variables__bare">
      {button}
      <WriteScript node={node} />
    </div>
  );
}
