// Which lines of the generated code belong to which element, both ways.

import type { CodeMark } from '../../protocol/messages';
import { pillKey } from './board';
import { kStart } from './model';

/** The key of an element on the canvas, from the keys that lead to it in the file. */
export function elementKey(keys: readonly string[]): string | null {
  const [where, name, part, inner] = keys;
  if (where === 'start') return part === undefined ? kStart : `${kStart}/${part}`;
  if (name === undefined) return null;
  if (where === 'configuration') return pillKey(name);
  if (where !== 'actors') return null;
  return part === 'supervisors' && inner !== undefined ? `${name}/${inner}` : name;
}

export function marksOf(marks: readonly CodeMark[], key: string | null): CodeMark[] {
  return marks.filter((one) => elementKey(one.keys) === key);
}

/** The element that a line is about; null: the line is about the whole plan. */
export function elementAt(marks: readonly CodeMark[], line: number): string | null {
  const mark = marks.find((one) => one.first <= line && line <= one.last);
  return mark ? elementKey(mark.keys) : null;
}
