// Words of a node as they come in binary frames (topic variables), and how names lead to them.

import type { Variable } from '../protocol/messages';

/** Walks the records of a frame: u16 address, u16 count, count times i16. Stops at what does not fit. */
export function eachRecord(
  payload: DataView,
  act: (address: number, count: number, valueAt: (index: number) => number) => void,
): void {
  let at = 0;
  while (at + 4 <= payload.byteLength) {
    const address = payload.getUint16(at, true);
    const count = payload.getUint16(at + 2, true);
    const from = at + 4;
    at = from + count * 2;
    if (at > payload.byteLength) return;
    act(address, count, (index) => payload.getInt16(from + index * 2, true));
  }
}

/** Adds the records of a frame of the topic variables. */
export function readWords(payload: DataView, into: Map<number, number>): void {
  eachRecord(payload, (address, count, valueAt) => {
    for (let index = 0; index < count; index++) into.set(address + index, valueAt(index));
  });
}

/** Walks the records of a frame of the topic samples: f64 time, u16 index into of.words, i16 value. */
export function eachSample(
  payload: DataView,
  act: (time: number, word: number, value: number) => void,
): void {
  for (let at = 0; at + 12 <= payload.byteLength; at += 12)
    act(
      payload.getFloat64(at, true),
      payload.getUint16(at + 8, true),
      payload.getInt16(at + 10, true),
    );
}

export interface Mentioned {
  /** As it is in the text: event.args[1]. */
  shown: string;
  address: number;
  count: number;
}

/** The variables that a line names, with an element where its index is a number. */
export function mentionedIn(line: string, variables: readonly Variable[]): Mentioned[] {
  const byName = new Map(variables.map((variable) => [variable.name, variable]));
  const found = new Map<string, Mentioned>();
  for (const [, name = '', index] of line
    .replace(/#.*$/, '')
    .matchAll(/([A-Za-z_][\w.]*)(?:\[\s*(\d+)\s*\])?/g)) {
    const variable = byName.get(name);
    if (!variable || (index !== undefined && Number(index) >= variable.size)) continue;
    const shown = index === undefined ? name : `${name}[${index}]`;
    const count = index === undefined ? Math.min(variable.size, kElementsShown) : 1;
    found.set(shown, { shown, address: variable.address + Number(index ?? 0), count });
  }
  return [...found.values()];
}

/** Of an array so many elements are shown beside the code. */
const kElementsShown = 8;

/** "event.args[1] = 164", or "" while a word is not known. */
export function valueText(mentioned: Mentioned, words: ReadonlyMap<number, number>): string {
  const values = Array.from({ length: mentioned.count }, (_, index) =>
    words.get(mentioned.address + index),
  );
  if (values.some((value) => value === undefined)) return '';
  return `${mentioned.shown} = ${values.length === 1 ? values[0] : `[${values.join(', ')}]`}`;
}
