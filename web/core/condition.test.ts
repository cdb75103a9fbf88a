import { expect, it } from 'vitest';
import { mistakeIn } from './condition';

it('what can be a condition of a script or a plan is none', () => {
  for (const good of [
    '',
    'token > 3',
    'speed > 100 and not (prox.horizontal[2] == 0 or state == WAITING)',
    '-a * -(b + 1) % 3 <= 0x1F',
    'abs(x - y) << 2 != ~z',
    'min(a, b, 3) == n',
    'not done',
    'name == "two words" & \'x\'',
    '1.5e3 < distance',
  ])
    expect([good, mistakeIn(good)]).toEqual([good, '']);
});

it('what cannot is told, with what was expected', () => {
  const told = {
    'token >': 'expected a value after “>”',
    '> 3': 'expected a value before “>”',
    'a b': 'expected an operator before “b”',
    'a not b': 'expected an operator before “not”',
    '(a == 1': 'expected “)” at the end',
    'a == 1)': 'expected no “)” here',
    'list[1': 'expected “]” at the end',
    'list[]': 'expected a value before “]”',
    'a, b': 'expected no “,” here',
    'a = 1': '= 1: expected a name, a number or an operator',
    'a and': 'expected a value after “and”',
    '3[1]': 'expected an operator before “[”',
  };
  for (const [bad, what] of Object.entries(told))
    expect([bad, mistakeIn(bad)]).toEqual([bad, what]);
});
