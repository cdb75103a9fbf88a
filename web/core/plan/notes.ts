// Notes on the canvas, kept in the file under x.notes. What else is in that list stays.

import type { Json, JsonStep } from '../../protocol/messages';
import { setSteps, valueAt } from './edit';
import type { Note } from './model';
import { snapped } from './place';
import type { Point } from './shape';

export interface Size {
  width: number;
  height: number;
}

export const kNoteSize: Size = { width: 192, height: 72 };
export const kNoteLeast: Size = { width: 64, height: 32 };

const kKeys = ['x', 'notes'];

/** Notes have no names: they are told apart by their place in the list. */
export const noteKey = (index: number) => `note:${index}`;

export function noteIndex(key: string): number | null {
  const digits = /^note:(\d+)$/.exec(key)?.[1];
  return digits === undefined ? null : Number(digits);
}

/** null: something else is where notes are kept. */
export function addNote(
  file: Json,
  { x, y }: Point,
  text = '',
): { steps: JsonStep[]; key: string } | null {
  const list = valueAt(file, kKeys);
  const note = { at: [x, y], size: [kNoteSize.width, kNoteSize.height], text };
  if (list === undefined) return { steps: setSteps(file, kKeys, [note]), key: noteKey(0) };
  if (!Array.isArray(list)) return null;
  const at = [...kKeys, list.length];
  return { steps: [{ do: 'insert', at, value: note }], key: noteKey(list.length) };
}

const set = (index: number, member: string, value: Json): JsonStep => ({
  do: 'set',
  at: [...kKeys, index, member],
  value,
});

export function moveNote(note: Note, { x, y }: Point): JsonStep[] {
  return note.at[0] === x && note.at[1] === y ? [] : [set(note.index, 'at', [x, y])];
}

export function resizeNote(note: Note, wanted: Size): JsonStep[] {
  const { width, height } = fitting(wanted);
  const isSame = note.size[0] === width && note.size[1] === height;
  return isSame ? [] : [set(note.index, 'size', [width, height])];
}

export function fitting({ width, height }: Size): Size {
  return {
    width: Math.max(kNoteLeast.width, snapped(width)),
    height: Math.max(kNoteLeast.height, snapped(height)),
  };
}

export function writeNote(note: Note, text: string): JsonStep[] {
  return note.text === text ? [] : [set(note.index, 'text', text)];
}

/** The last one of the list if nothing is left of it takes the list along. */
export function removeNote(file: Json, index: number): JsonStep[] {
  const list = valueAt(file, kKeys);
  if (!Array.isArray(list) || index >= list.length) return [];
  if (list.length > 1) return [{ do: 'remove', at: [...kKeys, index] }];
  const holder = valueAt(file, ['x']);
  const isAlone = Object.keys(typeof holder === 'object' && holder ? holder : {}).length === 1;
  return [{ do: 'remove', at: isAlone ? ['x'] : kKeys }];
}

/** Later notes first, so that none moves another before it is its turn. */
export function inRemovalOrder(keys: Iterable<string>): string[] {
  return [...keys].sort((a, b) => (noteIndex(b) ?? -1) - (noteIndex(a) ?? -1));
}
