import { expect, test } from 'vitest';
import type { FormulaWord } from '../../protocol/messages';
import { completed, offersFor, wordAt } from './completion';
import type { Variable } from './model';

const variable = (name: string, type: string, unit: string): Variable => ({
  name,
  type,
  unit,
  initial: '',
});
const variables = [variable('speed', 'float', 'cm/s'), variable('maxSpeed', 'int', '')];
const words: FormulaWord[] = [
  { name: 'sqrt', is: 'function', form: 'sqrt(x)', help: 'the square root' },
  { name: 'and', is: 'operator', form: 'a and b', help: 'true if both sides are' },
  { name: '<=', is: 'operator', form: 'a <= b', help: '' },
];

test('the word at the caret is the one it is in or behind', () => {
  expect(wordAt('speed * 2', 5)).toEqual({ from: 0, to: 5 });
  expect(wordAt('2 * speed', 6)).toEqual({ from: 4, to: 9 });
  expect(wordAt('2 * ', 4)).toEqual({ from: 4, to: 4 });
});

test('in quotes and in numbers there is none', () => {
  expect(wordAt('"spe', 4)).toBeNull();
  expect(wordAt('"a" & spe', 9)).toEqual({ from: 6, to: 9 });
  expect(wordAt("'say \"' & x", 11)).toEqual({ from: 10, to: 11 });
  expect(wordAt('12', 2)).toBeNull();
  expect(wordAt('0.5', 3)).toBeNull();
});

test('what begins with the word comes before what contains it', () => {
  expect(offersFor(variables, words, 's').map((one) => one.name)).toEqual([
    'speed',
    'sqrt',
    'maxSpeed',
  ]);
  expect(offersFor(variables, words, 'SP')[0]).toEqual({
    name: 'speed',
    is: 'variable',
    detail: 'float, cm/s',
    help: '',
  });
  // What is there already needs no offer; signs are typed.
  expect(offersFor(variables, words, 'speed').map((one) => one.name)).toEqual(['maxSpeed']);
  expect(offersFor(variables, words, 'speed', true)[0]?.name).toBe('speed');
  expect(offersFor(variables, words, '').map((one) => one.name)).not.toContain('<=');
});

test('a chosen word replaces the one at the caret', () => {
  const [sqrt] = offersFor([], words, 'sq');
  if (!sqrt) throw new Error('sqrt is not offered');
  expect(completed('2 * sq + 1', { from: 4, to: 6 }, sqrt)).toEqual({
    text: '2 * sqrt() + 1',
    caret: 9,
  });
  // Its parentheses are there already.
  expect(completed('sq(4)', { from: 0, to: 2 }, sqrt)).toEqual({ text: 'sqrt(4)', caret: 5 });
  const [speed] = offersFor(variables, [], 'sp');
  if (!speed) throw new Error('speed is not offered');
  expect(completed('sp * 2', { from: 0, to: 2 }, speed)).toEqual({ text: 'speed * 2', caret: 5 });
});
