import { expect, test } from 'vitest';
import { linesNamed } from './lines_named';

test('lines that follow each other are named together', () => {
  expect(linesNamed([])).toBe('');
  expect(linesNamed([3, 5, 6, 7, 12])).toBe('3, 5 to 7, 12');
});
