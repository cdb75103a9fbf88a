import { expect, test } from 'vitest';
import { mistakeIn, mistakeInLine } from './formula_place';

const meant = (formula: string, sentence: string) => {
  const span = mistakeIn(formula, sentence);
  return span && [span.from, formula.slice(span.from, span.to)];
};

test('APositionMeansTheTokenThere', () => {
  expect(meant('2 + * 3', 'expected a number at position 5, found "*"')).toEqual([4, '*']);
  expect(meant('1 + sqrt(1, 2)', 'sqrt at position 5 has 2 arguments')).toEqual([4, 'sqrt']);
  expect(meant('a < b <= c', '"<=" at position 7: a comparison cannot follow')).toEqual([6, '<=']);
});

test('PositionsCountBytes', () => {
  expect(meant("'ü' + *", 'expected a number at position 8, found "*"')).toEqual([6, '*']);
});

test('AtTheEndItsLastCharacterIsMeant', () => {
  expect(meant('(1 ', 'expected an operator at position 4, found the end')).toEqual([1, '1']);
  expect(mistakeIn('', 'expected a number at position 1, found the end')).toBeNull();
});

test('AVariableIsFoundAsAWordOfItsOwn', () => {
  const sentence = 'uses the variable "sped", which does not exist';
  expect(meant('sped2 + x.sped + sped', sentence)).toEqual([17, 'sped']);
  expect(mistakeIn('speed', sentence)).toBeNull();
});

test('ASentenceWithoutAPlaceMeansTheWholeFormula', () => {
  expect(mistakeIn('true', 'the formula for "seconds" is a bool')).toBeNull();
});

test('InAFileThePlaceOfTheMemberLeadsToTheFormula', () => {
  const line = '  "in": { "seconds": "2 * sped" },';
  const sentence = 'the formula for "seconds" uses the variable "sped", which does not exist';
  const span = { from: line.indexOf('sped'), to: line.indexOf('sped') + 4 };
  expect(mistakeInLine(line, line.indexOf('"seconds"'), sentence)).toEqual(span);
  expect(mistakeInLine(line, line.indexOf('"2'), sentence)).toEqual(span);
  expect(mistakeInLine('"a": "\\u0041 sped"', 0, sentence)).toBeNull();
  expect(mistakeInLine('"a": 2', 0, sentence)).toBeNull();
});
