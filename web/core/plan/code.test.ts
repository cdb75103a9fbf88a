import { expect, test } from 'vitest';
import type { CodeMark } from '../../protocol/messages';
import { elementAt, elementKey, marksOf } from './code';

const marks: CodeMark[] = [
  { keys: ['actors', 'go'], first: 10, last: 11 },
  { keys: ['actors', 'go', 'supervisors', 'see'], first: 14, last: 14 },
  { keys: ['start', 'supervisors', 'see'], first: 15, last: 15 },
  { keys: ['configuration', 'speed'], first: 18, last: 18 },
  { keys: ['start'], first: 19, last: 19 },
  { keys: ['actors', 'go'], first: 22, last: 24 },
];

test('keys of the file lead to the element on the canvas', () => {
  expect(marks.map((one) => elementKey(one.keys))).toEqual([
    'go',
    'go/see',
    '@start/see',
    '$speed',
    '@start',
    'go',
  ]);
  expect(elementKey(['layout', 'go'])).toBeNull();
});

test('an element has its lines, a line its element', () => {
  expect(marksOf(marks, 'go').map((one) => one.first)).toEqual([10, 22]);
  expect(elementAt(marks, 11)).toBe('go');
  expect(elementAt(marks, 14)).toBe('go/see');
  expect(elementAt(marks, 12)).toBeNull();
});
