// The list of variables as rows: nodes, below them their variables, below unfolded arrays their
// elements. Pure: what is known, what is looked for and what is unfolded go in, rows come out.

import type { Node, NodeId, Variable } from '../protocol/messages';

/** A node with its variables; undefined until its description has come. */
export interface NodeVariables {
  node: Pick<Node, 'id' | 'name' | 'state'>;
  variables: readonly Variable[] | undefined;
}

export type VariableRow =
  | { is: 'node'; key: string; node: NodeId; name: string; state: Node['state']; open: boolean }
  | { is: 'group'; key: string; node: NodeId; of: Variable['of']; count: number }
  | { is: 'variable'; key: string; node: NodeId; variable: Variable; open: boolean }
  | { is: 'element'; key: string; node: NodeId; variable: Variable; index: number }
  | { is: 'waits'; key: string; node: NodeId };

export interface RowsAsked {
  find: string;
  /** Keys of rows that are not as they are by themselves: nodes and arrays. */
  toggled: ReadonlySet<string>;
  /** The node that is unfolded by itself. */
  shown: NodeId | null;
}

export function nodeKey(node: NodeId): string {
  return `${node}`;
}

export function variableKey(node: NodeId, name: string): string {
  return `${node}/${name}`;
}

/** A node is unfolded if it is the one that is looked at; while something is looked for, all are. */
export function isOpen(node: NodeId, { find, toggled, shown }: RowsAsked): boolean {
  if (find.trim() !== '') return true;
  return (node === shown) !== toggled.has(nodeKey(node));
}

export function variableRows(nodes: readonly NodeVariables[], asked: RowsAsked): VariableRow[] {
  const words = asked.find.toLowerCase().split(/\s+/).filter(Boolean);
  return nodes.flatMap((one) => rowsOf(one, asked, words));
}

function rowsOf(
  { node, variables }: NodeVariables,
  asked: RowsAsked,
  words: readonly string[],
): VariableRow[] {
  const open = isOpen(node.id, asked);
  const head: VariableRow = {
    is: 'node',
    key: nodeKey(node.id),
    node: node.id,
    name: node.name,
    state: node.state,
    open,
  };
  if (!open) return [head];
  if (!variables) return words.length > 0 ? [] : [head, waits(node.id)];
  const found = variables.filter((variable) => matches(node.name, variable, words));
  if (found.length === 0 && words.length > 0) return [];
  return [
    head,
    ...groupOf(node.id, found, 'script', asked),
    ...groupOf(node.id, found, 'node', asked),
  ];
}

function waits(node: NodeId): VariableRow {
  return { is: 'waits', key: `${node} waits`, node };
}

function groupOf(
  node: NodeId,
  variables: readonly Variable[],
  of: Variable['of'],
  asked: RowsAsked,
): VariableRow[] {
  const own = variables.filter((variable) => variable.of === of);
  if (own.length === 0) return [];
  return [
    { is: 'group', key: `${node} ${of}`, node, of, count: own.length },
    ...own.flatMap((variable) => variableAndElements(node, variable, asked)),
  ];
}

function variableAndElements(
  node: NodeId,
  variable: Variable,
  { toggled }: RowsAsked,
): VariableRow[] {
  const key = variableKey(node, variable.name);
  const open = variable.size > 1 && toggled.has(key);
  const row: VariableRow = { is: 'variable', key, node, variable, open };
  if (!open) return [row];
  return [
    row,
    ...Array.from({ length: variable.size }, (_, index): VariableRow => {
      return { is: 'element', key: `${key}[${index}]`, node, variable, index };
    }),
  ];
}

/** Each word is in the name of the node or of the variable, or in its help. */
function matches(node: string, variable: Variable, words: readonly string[]): boolean {
  const text = `${node}.${variable.name} ${variable.help ?? ''}`.toLowerCase();
  return words.every((word) => text.includes(word));
}

/** An array as bars: for each column from, to in parts of the height, 0 at the top. */
export interface Bar {
  from: number;
  to: number;
}

/** Bars of an array; with more words than columns each column is the farthest from zero of its words. */
export function barsOf(values: readonly (number | undefined)[], columns: number): Bar[] {
  const count = Math.min(columns, values.length);
  const chosen = Array.from({ length: count }, (_, column) => {
    const from = Math.floor((column * values.length) / count);
    const end = Math.max(from + 1, Math.floor(((column + 1) * values.length) / count));
    return values
      .slice(from, end)
      .map((value) => value ?? 0)
      .reduce((far, value) => (Math.abs(value) > Math.abs(far) ? value : far), 0);
  });
  const top = Math.max(0, ...chosen);
  const span = top - Math.min(0, ...chosen) || 1;
  const zero = top / span;
  return chosen.map((value) => ({
    from: Math.min(zero, zero - value / span),
    to: Math.max(zero, zero - value / span),
  }));
}
