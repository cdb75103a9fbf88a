import { expect, test } from 'vitest';
import type { Finding } from '../../protocol/messages';
import { findingsAt, findingsOfElement, wantedBy } from './row_findings';

const finding = (what: string, ...keys: string[]): Finding => ({
  doc: 'P.plan.json',
  severity: 'error',
  code: 'P8',
  at: { line: 1, column: 1 },
  end: { line: 1, column: 2 },
  what,
  fixes: [],
  keys,
});
const all = [
  finding('a formula', 'actors', 'go', 'in', 'speed'),
  finding('a state', 'actors', 'go', 'states', 'Done'),
  finding('not fed', 'actors', 'go'),
  finding('no such template', 'actors', 'go', 'template'),
  finding('of its supervisor', 'actors', 'go', 'supervisors', 'see', 'in', 'speed'),
  finding('of another', 'actors', 'gone', 'in', 'speed'),
];
const whats = (findings: Finding[]) => findings.map((one) => one.what);

test('a row shows what means exactly its member', () => {
  expect(whats(findingsAt(all, ['actors', 'go', 'in', 'speed']))).toEqual(['a formula']);
  expect(whats(findingsAt(all, ['actors', 'go', 'states', 'Done']))).toEqual(['a state']);
  expect(findingsAt(all, ['actors', 'go', 'in', 'time'])).toEqual([]);
});

test('the head of an element shows what no row shows', () => {
  expect(whats(findingsOfElement(all, ['actors', 'go']))).toEqual(['not fed', 'no such template']);
  expect(findingsOfElement(all, ['actors', 'go', 'supervisors', 'see'])).toEqual([]);
});

test.each([
  ['P3', ['actors', 'go', 'in', 'speed'], { is: 'value', name: 'speed' }],
  ['P17', ['actors', 'go', 'states', 'Done'], { is: 'arrow', name: 'Done' }],
  ['P18', ['start', 'supervisors', 'see', 'events', 'Seen'], { is: 'arrow', name: 'Seen' }],
  ['P15', ['start', 'actor'], { is: 'arrow', name: '' }],
  ['P8', ['actors', 'go', 'in', 'speed'], { is: 'formula', name: 'speed' }],
  ['P11', ['start', 'supervisors', 'see', 'in', 'far'], { is: 'formula', name: 'far' }],
  ['P8', ['actors', 'go', 'out', 'speed'], null],
  ['P3', ['actors', 'go'], null],
])('WhatHelpsWith %s at %j', (code, keys, wanted) =>
  expect(wantedBy({ ...finding('', ...keys), code })).toEqual(wanted),
);
