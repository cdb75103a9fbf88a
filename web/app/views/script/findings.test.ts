// When the sentence of an error comes below its line.
import { EditorState } from '@codemirror/state';
import { expect, it } from 'vitest';
import type { Finding } from '../../../protocol/messages';
import { findingsExtension, linesWithSentence, setFindings } from './findings';

const finding = (line: number) =>
  ({
    severity: 'error',
    what: 'wrong',
    at: { line, column: 1 },
    end: { line, column: 2 },
    fixes: [],
  }) as unknown as Finding;
const told = (...lines: number[]) =>
  setFindings.of({ findings: lines.map(finding), onFix: () => {} });

/** Three lines, the caret in the second, where a letter is typed. */
function typing(): EditorState {
  const start = EditorState.create({
    doc: 'aa\nbb\ncc',
    selection: { anchor: 5 },
    extensions: findingsExtension,
  });
  return start.update({
    changes: { from: 5, insert: 'x' },
    selection: { anchor: 6 },
    userEvent: 'input.type',
  }).state;
}

it('a sentence waits below the line that is being typed, not below others', () => {
  const state = typing().update({ effects: told(1, 2) }).state;
  expect(linesWithSentence(state)).toEqual([1]);
});

it('it comes when the caret leaves the line', () => {
  const state = typing().update({ effects: told(2) }).state;
  expect(linesWithSentence(state.update({ selection: { anchor: 4 } }).state)).toEqual([]);
  expect(linesWithSentence(state.update({ selection: { anchor: 0 } }).state)).toEqual([2]);
});

it('one that is there does not go while its line is typed', () => {
  const { state: shown } = typing().update({ selection: { anchor: 0 }, effects: told(2) });
  expect(linesWithSentence(shown)).toEqual([2]);
  const { state: again } = shown.update({
    changes: { from: 6, insert: 'y' },
    selection: { anchor: 7 },
    userEvent: 'input.type',
  });
  const good = again.update({ effects: told() }).state;
  expect(linesWithSentence(good)).toEqual([2]);
  expect(linesWithSentence(good.update({ selection: { anchor: 0 } }).state)).toEqual([]);
});

it('what was pasted, loaded or changed by others is told at once', () => {
  const start = EditorState.create({ doc: 'aa\nbb', extensions: findingsExtension });
  const { state } = start.update({ changes: { from: 0, insert: 'x' }, effects: told(1) });
  expect(linesWithSentence(state)).toEqual([1]);
});
