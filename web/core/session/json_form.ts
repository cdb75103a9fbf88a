// The saved form of JSON files (docs/formats.md): what a new value looks like, and whether a file is
// written in that form as a whole. The same as src/base/json_format.cpp.

import type { Json } from '../../protocol/messages';
import { readTree, type Tree } from './json_text';

/** Characters of a line, with indentation, key and comma. */
export const kLineMax = 100;

export function treeOf(value: Json): Tree {
  return readTree(JSON.stringify(value));
}

/** `{ "a": 1, "b": [2, 3] }` */
export function inOneLine(tree: Tree): string {
  if (tree.kind === 'scalar') return tree.raw;
  const parts = tree.parts.map(({ rawKey, value }) =>
    tree.kind === 'object' ? `${rawKey}: ${inOneLine(value)}` : inOneLine(value),
  );
  if (tree.kind === 'array') return `[${parts.join(', ')}]`;
  return parts.length > 0 ? `{ ${parts.join(', ')} }` : '{}';
}

/** A whole file, with its last line end. */
export function savedForm(tree: Tree): string {
  const isRootList = tree.kind === 'array';
  return written(tree, { depth: 0, prefix: '', suffix: '', isRootList });
}

/** A value for a place of that depth, behind `prefix` (its key); without the first indentation. */
export function formedPart(tree: Tree, depth: number, prefix: string): string {
  const indent = ' '.repeat(depth * 2);
  const place = { depth, prefix: indent + prefix, suffix: ',', isRootList: false };
  return written(tree, place).slice(indent.length + prefix.length, -2);
}

interface Place {
  depth: number;
  prefix: string;
  suffix: string;
  isRootList: boolean;
}

function written(tree: Tree, place: Place): string {
  const { depth, prefix, suffix, isRootList } = place;
  const mustOpen = tree.kind === 'object' && depth <= 1 && !isRootList;
  if (tree.parts.length === 0 || (!mustOpen && fits(tree, prefix, suffix)))
    return `${prefix}${inOneLine(tree)}${suffix}\n`;
  const [open, close] = tree.kind === 'object' ? ['{', '}'] : ['[', ']'];
  const indent = ' '.repeat(depth * 2 + 2);
  const lines = tree.parts.map(({ rawKey, value }, index) =>
    written(value, {
      depth: depth + 1,
      prefix: indent + (tree.kind === 'object' ? `${rawKey}: ` : ''),
      suffix: index + 1 < tree.parts.length ? ',' : '',
      isRootList,
    }),
  );
  return `${prefix}${open}\n${lines.join('')}${' '.repeat(depth * 2)}${close}${suffix}\n`;
}

function fits(tree: Tree, prefix: string, suffix: string): boolean {
  if (leastLength(tree, kLineMax) > kLineMax) return false;
  return [...(prefix + inOneLine(tree))].length + suffix.length <= kLineMax;
}

/** No more than its length, counted until it is too much: big values are not written at each level. */
function leastLength(tree: Tree, enough: number): number {
  let sum = 1 + tree.raw.length / 2;
  for (const { value } of tree.parts) {
    if (sum > enough) return sum;
    sum += leastLength(value, enough - sum);
  }
  return sum;
}
