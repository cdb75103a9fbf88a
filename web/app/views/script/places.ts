// Places of the protocol (line and column in characters, from 1) and offsets of the editor (UTF-16).

import type { Text } from '@codemirror/state';
import type { Place } from '../../../protocol/messages';

export function offsetOf(doc: Text, place: Place): number {
  if (place.line > doc.lines) return doc.length;
  const line = doc.line(Math.max(1, place.line));
  let units = 0;
  let characters = 1;
  for (const letter of line.text) {
    if (characters >= place.column) break;
    units += letter.length;
    characters++;
  }
  return line.from + units;
}

export function placeOf(doc: Text, offset: number): Place {
  const line = doc.lineAt(offset);
  return { line: line.number, column: [...line.text.slice(0, offset - line.from)].length + 1 };
}
