import { expect, it } from 'vitest';
import { humpsOf } from './humps';

it('a name goes on in the next line before a capital and behind a low line', () => {
  expect(humpsOf('turnAfterWallLost')).toEqual(['turn', 'After', 'Wall', 'Lost']);
  expect(humpsOf('wall_lost')).toEqual(['wall_', 'lost']);
  expect(humpsOf('step2Back')).toEqual(['step2', 'Back']);
  expect(humpsOf('CAN')).toEqual(['CAN']);
  expect(humpsOf('wait')).toEqual(['wait']);
  expect(humpsOf('')).toEqual(['']);
});
