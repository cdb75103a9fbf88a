import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { FleetOutcome, FleetRobot } from '../protocol/messages';
import {
  allOf,
  clicked,
  countDoings,
  doingOf,
  inBatches,
  keyed,
  kRobotsAtOnce,
  listOf,
  noChoice,
  readVariable,
  shownSpan,
  sortedOutcomes,
  toggled,
} from './fleet';

const robot = (more: Partial<FleetRobot> = {}): FleetRobot => ({
  connection: 'online',
  age: 'fresh',
  state: 'running',
  ...more,
});
const none = { shift: false, ctrl: false };
const shift = { shift: true, ctrl: false };
const ctrl = { shift: false, ctrl: true };

describe('what a robot does', () => {
  it.each([
    [robot(), 'running'],
    [robot({ state: 'fault' }), 'fault'],
    [robot({ age: 'stale' }), 'stuck'],
    [robot({ age: 'waiting' }), 'waiting'],
    [robot({ connection: 'lost', age: 'stale' }), 'lost'],
    [robot({ connection: 'offline', age: 'stale' }), 'offline'],
    [{ connection: 'online', age: 'fresh' } as const, 'waiting'],
    [robot({ connection: 'unknown', age: 'stale' }), 'lost'],
  ])('%o', (one, doing) => expect(doingOf(one, true)).toBe(doing));

  it('without a broker: what it did last, as nobody knows whether it is stuck', () => {
    expect(doingOf(robot({ age: 'stale', state: 'paused' }), false)).toBe('paused');
    expect(doingOf(robot({ age: 'stale', connection: 'lost' }), false)).toBe('lost');
  });

  it('is counted', () => {
    const counts = countDoings({ a: robot(), b: robot(), c: robot({ age: 'stale' }) }, true);
    expect(counts.running).toBe(2);
    expect(counts.stuck).toBe(1);
    expect(counts.fault).toBe(0);
  });
});

describe('the list', () => {
  const robots = {
    r10: robot({ actor: 'followWall', since_wall: 5 }),
    r2: robot({ state: 'fault', groups: ['red'], since_wall: 9 }),
    r1: robot({ problems: ['motor is not there'], vagus: '1.2.0' }),
    r3: robot({ connection: 'lost', vagus: '1.10.0' }),
  };
  it('is sorted as people count', () =>
    expect(listOf(robots, '', 'name', true)).toEqual(['r1', 'r2', 'r3', 'r10']));
  it('has robots of any name', () => {
    const odd = JSON.parse(
      '{"__proto__": {"connection": "online", "age": "fresh"}}',
    ) as typeof robots;
    expect(listOf(odd, '', 'state', true)).toEqual(['__proto__']);
  });
  it('has the worst first, among equals those with problems', () =>
    expect(listOf(robots, '', 'state', true)).toEqual(['r2', 'r3', 'r1', 'r10']));
  it('has those first that have done the same the longest', () =>
    expect(listOf(robots, '', 'since', true)).toEqual(['r10', 'r2', 'r1', 'r3']));
  it('is sorted by version', () =>
    expect(listOf(robots, '', 'version', true).slice(-2)).toEqual(['r1', 'r3']));
  it.each([
    ['wall', ['r10']],
    ['RED', ['r2']],
    ['motor there', ['r1']],
    ['lost', ['r3']],
    ['motor wall', []],
  ])('has what %s is in', (query, list) =>
    expect(listOf(robots, query, 'name', true)).toEqual(list),
  );
});

describe('choosing', () => {
  const list = ['a', 'b', 'c', 'd', 'e', 'f', 'g'];
  const names = (choice: { chosen: ReadonlySet<string> } | null) => [...(choice?.chosen ?? [])];

  it('a click chooses one, Ctrl one more, Shift a range', () => {
    const one = clicked(noChoice, list, 'b', none);
    expect(names(one)).toEqual(['b']);
    expect(names(clicked(one, list, 'e', ctrl))).toEqual(['b', 'e']);
    expect(names(clicked(one, list, 'd', shift))).toEqual(['b', 'c', 'd']);
    expect(names(clicked(clicked(one, list, 'd', shift), list, 'a', shift))).toEqual(['a', 'b']);
    expect(names(clicked(one, list, 'b', ctrl))).toEqual([]);
  });

  it('arrows go through rows and columns, and choose nothing', () => {
    const at = (key: string, from: string) => keyed({ ...noChoice, at: from }, list, key, 3, none);
    expect(at('ArrowRight', 'a')?.at).toBe('b');
    expect(at('ArrowDown', 'a')?.at).toBe('d');
    expect(at('ArrowUp', 'd')?.at).toBe('a');
    expect(at('ArrowUp', 'b')?.at).toBe('b');
    // g is alone in the last row: there is none below e.
    expect(at('ArrowDown', 'e')?.at).toBe('e');
    expect(at('ArrowLeft', 'a')?.at).toBe('a');
    expect(at('End', 'a')?.at).toBe('g');
    expect(at('Home', 'g')?.at).toBe('a');
    expect(names(at('End', 'a'))).toEqual([]);
    expect(at('x', 'a')).toBeNull();
  });

  it('a page is four rows, or as many as there are, and stays in its column', () => {
    const many = Array.from({ length: 20 }, (_, i) => String(i));
    const at = (key: string, from: string) =>
      keyed({ ...noChoice, at: from }, many, key, 3, none)?.at;
    expect(at('PageDown', '1')).toBe('13');
    expect(at('PageDown', '13')).toBe('19');
    expect(at('PageDown', '14')).toBe('17');
    expect(at('PageDown', '19')).toBe('19');
    expect(at('PageUp', '14')).toBe('2');
    expect(at('PageUp', '4')).toBe('1');
    expect(at('PageUp', '0')).toBe('0');
  });

  it('Space chooses, Shift extends, Ctrl+A chooses all, Escape none', () => {
    const b = keyed({ ...noChoice, at: 'b' }, list, ' ', 3, none) ?? noChoice;
    expect(names(b)).toEqual(['b']);
    const range = keyed(b, list, 'ArrowDown', 3, shift) ?? noChoice;
    expect(names(range)).toEqual(['b', 'c', 'd', 'e']);
    expect(names(keyed(range, list, 'ArrowLeft', 3, shift))).toEqual(['b', 'c', 'd']);
    expect(names(keyed(b, list, 'a', 3, ctrl))).toEqual(list);
    expect(names(keyed(b, list, 'Escape', 3, none))).toEqual([]);
    expect(keyed(noChoice, list, 'Escape', 3, none)).toBeNull();
  });

  it('does nothing in an empty list', () => {
    expect(keyed(noChoice, [], ' ', 3, none)).toBeNull();
    expect(keyed(noChoice, [], 'ArrowDown', 3, none)).toBeNull();
  });

  it('never chooses what is not in the list, whatever is pressed', () => {
    const key = fc.constantFrom(
      'ArrowUp',
      'ArrowDown',
      'ArrowLeft',
      'ArrowRight',
      ' ',
      'a',
      'End',
      'PageUp',
      'PageDown',
    );
    const hold = fc.record({ shift: fc.boolean(), ctrl: fc.boolean() });
    fc.assert(
      fc.property(
        fc.array(fc.tuple(key, hold)),
        fc.integer({ min: 1, max: 9 }),
        (keys, columns) => {
          let choice = noChoice;
          for (const [one, held] of keys)
            choice = keyed(choice, list, one, columns, held) ?? choice;
          expect(names(choice).every((name) => list.includes(name))).toBe(true);
        },
      ),
    );
  });

  it('keeps what is chosen and not shown until it is chosen otherwise', () => {
    const hidden = toggled(noChoice, 'z');
    expect(names(keyed({ ...hidden, at: 'a' }, list, ' ', 3, none))).toEqual(['z', 'a']);
    expect(names(allOf(hidden, list))).toEqual(list);
  });
});

describe('orders', () => {
  it('go to so many robots at a time', () => {
    const robots = Array.from({ length: kRobotsAtOnce + 1 }, (_, at) => `r${at}`);
    expect(inBatches(robots).map((batch) => batch.length)).toEqual([kRobotsAtOnce, 1]);
    expect(inBatches([])).toEqual([]);
  });

  it('are told by what became of them', () => {
    const outcome = (name: string, result: FleetOutcome['result']) => ({
      robot: name,
      result,
      what: '',
    });
    const sorted = sortedOutcomes([
      outcome('r10', 'silent'),
      outcome('r2', 'silent'),
      outcome('r1', 'done'),
    ]);
    expect(sorted.silent.map((one) => one.robot)).toEqual(['r2', 'r10']);
    expect(sorted.done).toHaveLength(1);
    expect(sorted.away).toEqual([]);
  });

  it.each([
    ['thymio-II.speed', { node: 'thymio-II', name: 'speed' }],
    ['thymio-II.motor.left.target', { node: 'thymio-II', name: 'motor.left.target' }],
    ['wallDistance', { name: 'wallDistance' }],
    ['.speed', null],
    ['node.', null],
    [' ', null],
  ])('read the variable %s', (text, variable) => expect(readVariable(text)).toEqual(variable));
});

it.each([
  [-5, '0 s'],
  [59_999, '59 s'],
  [60_000, '1 min'],
  [3_600_000, '1 h'],
  [90_000_000, '1 d'],
])('%i ms are shown as %s', (milliseconds, text) => expect(shownSpan(milliseconds)).toBe(text));
