import { expect, test } from 'vitest';
import { LogLines, logLinesOf, type LogLine } from './log_lines';

const line = (at: number, values = 'x'): LogLine => ({ doc: 'a.aesl#1', line: at, values });

function counted() {
  const lines = new LogLines();
  let changes = 0;
  const end = lines.changed.on(() => void changes++);
  return { lines, end, changes: () => changes };
}

test('what is shown is told once, when it changes', () => {
  const { lines, end, changes } = counted();
  expect(lines.all).toEqual([]);
  lines.show([line(3)]);
  expect(lines.all).toEqual([line(3)]);
  expect(changes()).toBe(1);
  // The same again, as another value.
  lines.show([line(3)]);
  expect(changes()).toBe(1);
  lines.show([line(3, 'x, y')]);
  lines.show([line(3, 'x, y'), line(4, '')]);
  lines.show([]);
  expect(changes()).toBe(4);
  expect(lines.all).toEqual([]);
  end();
  lines.show([line(5)]);
  expect(changes()).toBe(4);
});

test('none after none is no change', () => {
  const { lines, changes } = counted();
  lines.show([]);
  expect(changes()).toBe(0);
});

test('what is shown does not change with the list that it was told', () => {
  const { lines, changes } = counted();
  const told = [line(3)];
  lines.show(told);
  expect(lines.all).toEqual([line(3)]);
  lines.show([...told, line(4)]);
  expect(lines.all.map((one) => one.line)).toEqual([3, 4]);
  expect(changes()).toBe(2);
});

test('each window has its own, and always the same', () => {
  const here = {};
  logLinesOf(here).show([line(3)]);
  expect(logLinesOf(here).all).toEqual([line(3)]);
  expect(logLinesOf({}).all).toEqual([]);
});
