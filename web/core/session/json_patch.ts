// Steps applied to the text of a JSON file: only what a step means changes, all else keeps its form.
// A text in the saved form stays in it. What src/serve/edit/json_patch.cpp promises.

import { ChangeSet } from '@codemirror/state';
import type { Json, JsonStep } from '../../protocol/messages';
import { textDiff } from '../text_diff';
import { formedPart, inOneLine, savedForm, treeOf } from './json_form';
import {
  indexIn,
  insertPart,
  isOpen,
  readTree,
  takePart,
  textOfTree,
  type Key,
  type Tree,
} from './json_text';
import { keyOrder } from './key_order';

export interface Patched {
  text: string;
  changes: ChangeSet;
}

/** Throws if a step does not fit the text, or the text is no JSON. */
export function patch(text: string, language: string, steps: readonly JsonStep[]): Patched {
  JSON.parse(text);
  const isSaved = savedForm(readTree(text)) === text;
  let current = text;
  let changes = ChangeSet.empty(text.length);
  // Each step by itself: what lies between two of them is nobody's, and others may edit it.
  for (const step of steps) {
    const tree = readTree(current);
    const root = new Patcher(tree, language).apply(step);
    const next = isSaved ? savedForm(root) : withRim(current, textOfTree(root));
    changes = changes.compose(ChangeSet.of(tokenDiff(current, next), current.length));
    current = next;
  }
  return { text: current, changes };
}

/** Whole scalars: "15" and "16" are two values, and not one with another digit. */
function tokenDiff(before: string, after: string): { from: number; to: number; insert: string }[] {
  return textDiff(before, after).map(({ from, to, insert }) => {
    // What was, and what will be, at the two ends.
    const first = isWord(before[from]) || isWord(insert[0] ?? before[to]);
    const last = isWord(before[to - 1]) || isWord(insert.at(-1) ?? before[from - 1]);
    let start = from;
    let end = to;
    while (first && isWord(before[start - 1])) start--;
    while (last && isWord(before[end])) end++;
    const whole = before.slice(start, from) + insert + before.slice(to, end);
    return { from: start, to: end, insert: whole };
  });
}

function isWord(letter: string | undefined): boolean {
  return letter !== undefined && /[\w.+-]/.test(letter);
}

function withRim(before: string, text: string): string {
  const [, start = ''] = /^(\s*)/.exec(before) ?? [];
  const [, end = ''] = /\S(\s*)$/.exec(before) ?? [];
  return start + text + end;
}

class Patcher {
  private path: string[] = [];

  constructor(
    private root: Tree,
    private readonly language: string,
  ) {}

  apply(step: JsonStep): Tree {
    if (step.at.length === 0) {
      this.root = readTree(savedForm(this.formed(step.value ?? null, [])));
      return this.root;
    }
    const keys = step.at as Key[];
    const holder = this.holder(keys);
    const key = keys.at(-1) ?? '';
    if (holder.kind !== (typeof key === 'string' ? 'object' : 'array')) throw nothingAt(step);
    const index = indexIn(holder, key);
    if (index < 0 && !addsAt(step, holder)) throw nothingAt(step);
    this.act(holder, index, step);
    return this.root;
  }

  private act(holder: Tree, index: number, step: JsonStep): void {
    const depth = this.path.length;
    const key = (step.at as Key[]).at(-1) ?? '';
    const part = holder.parts[index];
    switch (step.do) {
      case 'set':
        if (part) part.value = this.value(holder, key, step.value ?? null);
        else this.add(holder, this.placeFor(holder, String(key)), key, step.value ?? null);
        return;
      case 'insert':
        if (typeof key === 'string') throw nothingAt(step);
        return this.add(holder, key, key, step.value ?? null);
      case 'remove':
        return void takePart(holder, index);
      case 'move':
        return move(holder, index, step.to ?? 0, depth);
    }
  }

  private holder(keys: readonly Key[]): Tree {
    let holder = this.root;
    for (const key of keys.slice(0, -1)) {
      const part = holder.parts[indexIn(holder, key)];
      if (!part) throw new Error(`There is nothing at ${JSON.stringify(keys)}.`);
      this.path.push(typeof key === 'string' ? key : '[]');
      holder = part.value;
    }
    return holder;
  }

  private add(holder: Tree, index: number, key: Key, value: Json): void {
    const isMember = typeof key === 'string';
    const part = {
      before: '',
      key: isMember ? key : '',
      rawKey: isMember ? JSON.stringify(key) : '',
      between: isMember ? ': ' : '',
      value: this.value(holder, key, value),
      after: '',
    };
    insertPart(holder, index, part, this.path.length);
  }

  /** Before the first member that the format has behind it. */
  private placeFor(holder: Tree, key: string): number {
    const order = keyOrder(this.language, this.path);
    const rankOf = (one: string) => (order.includes(one) ? order.indexOf(one) : order.length);
    const rank = rankOf(key);
    const behind = holder.parts.findIndex((part) => rankOf(part.key) > rank);
    return order.length === 0 || behind < 0 ? holder.parts.length : behind;
  }

  /** A new value as it is in that holder. */
  private value(holder: Tree, key: Key, value: Json): Tree {
    const path = [...this.path, typeof key === 'string' ? key : '[]'];
    const tree = this.formed(value, path);
    const [first] = holder.parts;
    if (first ? !isOpen(holder) : path.length > 2) return readTree(inOneLine(tree));
    const prefix = typeof key === 'string' ? `${JSON.stringify(key)}: ` : '';
    const text = formedPart(tree, path.length, prefix);
    return readTree(first ? movedIn(text, path.length, first.before) : text);
  }

  /** With its keys in the order of the format. */
  private formed(value: Json, path: readonly string[]): Tree {
    const tree = treeOf(value);
    sortKeys(tree, this.language, path);
    return tree;
  }
}

function addsAt(step: JsonStep, holder: Tree): boolean {
  if (step.do === 'set') return holder.kind === 'object';
  return step.do === 'insert' && Number(step.at.at(-1)) <= holder.parts.length;
}

function move(holder: Tree, index: number, to: number, depth: number): void {
  const { tail } = holder;
  if (to >= holder.parts.length) throw new Error(`There are only ${holder.parts.length} parts.`);
  const part = takePart(holder, index);
  if (!part) return;
  const { before } = part;
  insertPart(holder, to, part, depth);
  if (holder.parts.length === 1) part.before = before;
  holder.tail = tail;
}

function sortKeys(tree: Tree, language: string, path: readonly string[]): void {
  const order = keyOrder(language, path);
  const rankOf = (one: string) => (order.includes(one) ? order.indexOf(one) : order.length);
  if (order.length > 0 && tree.kind === 'object')
    tree.parts.sort((a, b) => rankOf(a.key) - rankOf(b.key));
  for (const { key, value } of tree.parts)
    sortKeys(value, language, [...path, tree.kind === 'object' ? key : '[]']);
}

/** Lines of a value that is written for its depth, below what the file has before its members. */
function movedIn(text: string, depth: number, before: string): string {
  return text.replaceAll('\n' + ' '.repeat(depth * 2), before.slice(before.lastIndexOf('\n')));
}

function nothingAt(step: JsonStep): Error {
  return new Error(`There is nothing at ${JSON.stringify(step.at)}.`);
}
