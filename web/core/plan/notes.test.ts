import { expect, test } from 'vitest';
import type { Json } from '../../protocol/messages';
import { applySteps } from '../json_steps';
import { planModel } from './model';
import { addNote, inRemovalOrder, moveNote, removeNote, resizeNote, writeNote } from './notes';

const plan: Json = { format: 'vagus-plan/1', name: 'P', actors: {} };
const note = (text: string) => ({ at: [8, 16], size: [192, 72], text });
const withNotes = (...notes: Json[]): Json => ({ format: 'vagus-plan/1', x: { notes } });
const notesOf = (file: Json) => planModel(file, []).notes;
const done = (file: Json, steps: Parameters<typeof applySteps>[1]) => applySteps(file, steps).value;

test('the first note makes its list, the next one comes after it', () => {
  const first = addNote(plan, { x: 8, y: 16 }, 'one');
  expect(first?.key).toBe('note:0');
  const once = done(plan, first?.steps ?? []);
  expect(once).toEqual({ ...(plan as object), x: { notes: [note('one')] } });
  const second = addNote(once, { x: 8, y: 16 }, 'two');
  expect(second?.key).toBe('note:1');
  expect(notesOf(done(once, second?.steps ?? [])).map((one) => one.text)).toEqual(['one', 'two']);
});

test('what is no list of notes is left alone', () => {
  expect(addNote({ x: { notes: 'mine' } }, { x: 0, y: 0 })).toBeNull();
});

test('a note is moved, resized and written at its own place in the list', () => {
  const file = withNotes('what others keep here', note('a'));
  const [only] = notesOf(file);
  if (!only) throw new Error('there is no note');
  const moved = done(file, moveNote(only, { x: 40, y: 48 }));
  const larger = done(moved, resizeNote(only, { width: 203, height: 10 }));
  const written = done(larger, writeNote(only, 'b'));
  // Sizes snap to 8; nothing is lower than 32.
  expect(written).toEqual(
    withNotes('what others keep here', { at: [40, 48], size: [200, 32], text: 'b' }),
  );
  expect(moveNote(only, { x: 8, y: 16 })).toEqual([]);
  expect(writeNote(only, 'a')).toEqual([]);
});

test('the last note takes its list along, and nothing else', () => {
  expect(done(withNotes(note('a')), removeNote(withNotes(note('a')), 0))).toEqual({
    format: 'vagus-plan/1',
  });
  const beside: Json = { x: { notes: [note('a')], mine: 1 } };
  expect(done(beside, removeNote(beside, 0))).toEqual({ x: { mine: 1 } });
  const two = withNotes(note('a'), note('b'));
  expect(done(two, removeNote(two, 0))).toEqual(withNotes(note('b')));
});

test('several are removed from the end', () => {
  expect(inRemovalOrder(['wait', 'note:2', 'note:10'])).toEqual(['note:10', 'note:2', 'wait']);
});
