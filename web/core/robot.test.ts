import fc from 'fast-check';
import { describe, expect, test, vi } from 'vitest';
import type { Happening, Variable } from '../protocol/messages';
import { Connection } from './connection';
import { csvOf } from './csv';
import { allEvents, Filtered, Happenings, kHappeningsMax, passes } from './happenings';
import { happeningsCsv } from './happenings_csv';
import { readWord, readWords, shortCount, shownRate, shownWord } from './numbers';
import { added, asPick, kPlanNode, moved, pickKey, placeOf, readPick, readPicks } from './picks';
import { kCurvesMax, noPlot, plotJson, readPlot, sourcesOf, withAxis, withCurve } from './plot';
import { summaryOf } from './plotter';
import { align, Ring } from './ring';
import { Studio } from './studio';
import { TestWorld } from './test_world';
import {
  arrowWidth,
  boxGap,
  flowsOf,
  kBoxesMax,
  kNobody,
  pictureOf,
  Rates,
  talkOf,
} from './traffic';
import { eachRecord, eachSample } from './values';
import { barsOf, variableRows } from './variable_rows';
import { kMarkMs, kSettleMs, rangesOf, type Seen } from './words';

const variable = (name: string, address: number, size = 1, of: 'node' | 'script' = 'node') =>
  ({ name, address, size, of, writable: true }) satisfies Variable;

describe('tables as text', () => {
  test('OnlyWhatNeedsQuotesHasThem', () => {
    expect(csvOf([['a', 'b,c', 'say "hi"', 3, undefined, 'two\nlines']])).toBe(
      'a,"b,c","say ""hi""",3,,"two\nlines"\r\n',
    );
  });
});

describe('words as they are typed and shown', () => {
  test('DecimalHexAndBinaryAreRead', () => {
    expect(['12', '-32768', '32767', '0xFFFF', '0x10', '-0x1', '0b101'].map(readWord)).toEqual([
      12, -32768, 32767, -1, 16, -1, 5,
    ]);
  });
  test('WhatIsNoWordIsRefused', () => {
    expect(['32768', '-32769', '1.5', 'x', '', '0x10000', '0b2', '1e3'].map(readWord)).toEqual(
      new Array(8).fill(null),
    );
  });
  test('AnArrayIsWordsWithSpacesOrCommas', () => {
    expect(readWords('[1, 2  3]')).toEqual([1, 2, 3]);
    expect(readWords('')).toEqual([]);
    expect(readWords('1 two')).toBeNull();
  });
  test('EveryWordIsReadAsItWasShown', () => {
    fc.assert(
      fc.property(fc.integer({ min: -32768, max: 32767 }), (value) => {
        expect(readWord(shownWord(value))).toBe(value);
        expect(readWord(shownWord(value, 'hex'))).toBe(value);
      }),
    );
    expect(shownWord(-1, 'hex')).toBe('0xFFFF');
    expect(shownWord(5, 'binary')).toBe('0000 0000 0000 0101');
    expect(shownWord(undefined)).toBe('–');
  });
  test('CountsAreShort', () => {
    expect([0, 9999, 12_345, 1_250_000].map(shortCount)).toEqual(['0', '9999', '12 k', '1.3 M']);
    expect([0, 0.42, 9.96, 120].map(shownRate)).toEqual(['0', '0.4', '10', '120']);
  });
});

describe('binary frames', () => {
  test('RecordsAreWalkedUntilOneDoesNotFit', () => {
    const view = new DataView(new ArrayBuffer(4 + 4 + 4 + 2));
    view.setUint16(0, 10, true);
    view.setUint16(2, 2, true);
    view.setInt16(4, -5, true);
    view.setInt16(6, 7, true);
    view.setUint16(8, 90, true);
    view.setUint16(10, 2, true); // claims two words, brings one
    const seen: [number, number[]][] = [];
    eachRecord(view, (address, count, at) =>
      seen.push([address, Array.from({ length: count }, (_, index) => at(index))]),
    );
    expect(seen).toEqual([[10, [-5, 7]]]);
  });
  test('SamplesAreTwelveBytesEach', () => {
    const view = new DataView(new ArrayBuffer(12 + 5));
    view.setFloat64(0, 1.25, true);
    view.setUint16(8, 3, true);
    view.setInt16(10, -9, true);
    const act = vi.fn();
    eachSample(view, act);
    expect(act.mock.calls).toEqual([[1.25, 3, -9]]);
  });
});

describe('rings of samples', () => {
  test('TheOldestGoesWhenItIsFullAndTimesOnlyGrow', () => {
    const ring = new Ring(3);
    for (const time of [1, 2, 2, 1.5, 3, 4]) ring.push(time, time * 10);
    expect([0, 1, 2].map((index) => ring.time(index))).toEqual([2, 3, 4]);
    expect([ring.at(1.9), ring.at(2), ring.at(3.5), ring.at(9)]).toEqual([undefined, 20, 30, 40]);
    expect([ring.from(0), ring.from(3), ring.from(3.1), ring.from(5)]).toEqual([0, 1, 2, 3]);
  });
  test('CurvesShareTheirTimes', () => {
    const [a, b] = [new Ring(9), new Ring(9)];
    [1, 2, 4].forEach((time) => a.push(time, time));
    [2, 3].forEach((time) => b.push(time, -time));
    // The sample before the span leads into it.
    expect(align([a, b], { from: 2.5, to: 4 }, 100)).toEqual({
      times: [2, 3, 4],
      values: [
        [2, null, 4],
        [-2, -3, null],
      ],
    });
  });
  test('ThinnedOutACurveKeepsItsPeaks', () => {
    const ring = new Ring(1000);
    for (let index = 0; index < 1000; index++) ring.push(index, index === 500 ? 99 : index % 2);
    const { times, values } = align([ring], { from: 0, to: 999 }, 100);
    expect(times.length).toBe(100);
    expect(Math.max(...(values[0] ?? []).map((value) => value ?? 0))).toBe(99);
  });
  test('ASummaryIsOfWhatIsInSight', () => {
    const ring = new Ring(9);
    [10, 20, 60].forEach((value, index) => ring.push(index, value));
    expect(summaryOf(ring, { from: 1, to: 5 })).toEqual({
      last: 60,
      least: 20,
      most: 60,
      mean: 40,
    });
    expect(summaryOf(ring, { from: 3, to: 5 })).toEqual({
      last: 60,
      least: 60,
      most: 60,
      mean: 60,
    });
    expect(summaryOf(new Ring(2), { from: 0, to: 1 }).last).toBeUndefined();
  });
});

describe('rows of variables', () => {
  const nodes = [
    {
      node: { id: 1, name: 'drive', state: 'running' as const },
      variables: [variable('id', 0), variable('args', 1, 3), variable('token', 4, 1, 'script')],
    },
    { node: { id: 2, name: 'range', state: 'paused' as const }, variables: undefined },
  ];
  const keys = (find: string, toggled: string[]) =>
    variableRows(nodes, { find, toggled: new Set(toggled), shown: 1 }).map((row) => row.key);
  test('TheNodeThatIsLookedAtIsUnfoldedItsScriptFirst', () => {
    expect(keys('', [])).toEqual(['1', '1 script', '1/token', '1 node', '1/id', '1/args', '2']);
  });
  test('ArraysAndOtherNodesAreUnfoldedOnDemand', () => {
    expect(keys('', ['1', '2'])).toEqual(['1', '2', '2 waits']);
    expect(keys('', ['1/args']).slice(-4)).toEqual(['1/args[0]', '1/args[1]', '1/args[2]', '2']);
  });
  test('WhatIsLookedForIsFoundInNodesAndNames', () => {
    expect(keys('drive arg', [])).toEqual(['1', '1 node', '1/args']);
    expect(keys('nothing', [])).toEqual([]);
  });
  test('BarsStandOnTheirZero', () => {
    expect(barsOf([10, -10, 0], 9)).toEqual([
      { from: 0, to: 0.5 },
      { from: 0.5, to: 1 },
      { from: 0.5, to: 0.5 },
    ]);
    expect(barsOf([1, 2, 3, -9], 2)).toHaveLength(2);
    expect(barsOf([undefined], 4)).toEqual([{ from: 0, to: 0 }]);
  });
});

describe('picked variables', () => {
  test('APickIsTypedWithOrWithoutItsNode', () => {
    const nodes = [{ id: 7, name: 'drive' }];
    expect(readPick('drive.wheel.speed', nodes, 3)).toEqual({ node: 7, name: 'wheel.speed' });
    expect(readPick('plan.rounds', nodes, 3)).toEqual({ node: kPlanNode, name: 'rounds' });
    expect(readPick(' args[2] ', nodes, 3)).toEqual({ node: 3, name: 'args', index: 2 });
    expect(readPick('thymio-II.prox[1]', [{ id: 5, name: 'thymio-II' }], null)).toEqual({
      node: 5,
      name: 'prox',
      index: 1,
    });
    expect([readPick('a b', nodes, 3), readPick('args', nodes, null)]).toEqual([null, null]);
  });
  test('APickIsFoundAgainByItsName', () => {
    const list = [variable('a', 0), variable('b', 1, 4)];
    expect(placeOf({ node: 1, name: 'b', index: 3 }, list)).toMatchObject({ first: 4, count: 1 });
    expect(placeOf({ node: 1, name: 'b' }, list)).toMatchObject({ first: 1, count: 4 });
    expect(placeOf({ node: 1, name: 'b', index: 4 }, list)).toBeUndefined();
  });
  test('WhatWasKeptIsCheckedWhenItComesBack', () => {
    expect(
      readPicks([{ node: 1, name: 'a' }, { node: 'x' }, 3, { node: 1, name: 'a', index: -1 }]),
    ).toEqual([{ node: 1, name: 'a' }]);
    expect(readPicks(undefined)).toEqual([]);
    expect(asPick({ node: 1, name: '' })).toBeNull();
  });
  test('OnePickIsThereOnceAndMovesAmongThoseOfItsNode', () => {
    const [a, b, c] = [
      { node: 1, name: 'a' },
      { node: 2, name: 'b' },
      { node: 1, name: 'c' },
    ] as const;
    const list = [a, b, c].reduce(added, [] as ReturnType<typeof added>);
    expect(added(list, a)).toHaveLength(3);
    expect(moved(list, c, -1).map(pickKey)).toEqual(['1/c', '2/b', '1/a']);
    expect(moved(list, a, -1)).toEqual(list);
  });
});

describe('what is plotted', () => {
  const word = (name: string, index?: number) =>
    ({
      is: 'word',
      pick: index === undefined ? { node: 1, name } : { node: 1, name, index },
    }) as const;
  test('CurvesDifferInColourAndComeBackAsTheyWereKept', () => {
    const plot = withAxis(
      withCurve(withCurve(withCurve(noPlot, word('a')), word('a')), {
        is: 'argument',
        event: 'hit',
        index: 1,
      }),
      word('a'),
      2,
    );
    expect(plot.curves.map(({ axis, colour }) => [axis, colour])).toEqual([
      [2, 0],
      [1, 1],
    ]);
    expect(readPlot(plotJson(plot))).toEqual(plot);
  });
  test('AnArrayGoesInAsItsFirstElements', () => {
    expect(sourcesOf({ node: 1, name: 'a' }, 20)).toHaveLength(8);
    expect(sourcesOf({ node: 1, name: 'a', index: 3 }, 1)).toEqual([word('a', 3)]);
  });
  test('NoMoreCurvesThanTheServerTakes', () => {
    const names = Array.from({ length: kCurvesMax + 1 }, (_, index) => word(`v${index}`));
    expect(names.reduce((plot, one) => withCurve(plot, one), noPlot).curves).toHaveLength(
      kCurvesMax,
    );
  });
  test('WhatIsNotUnderstoodIsLeftOut', () => {
    expect(
      readPlot({ span: 7, curves: [null, { axis: 9, event: 'e', index: 0 }, { pick: {} }] }),
    ).toEqual({
      span: 30,
      curves: [{ source: { is: 'argument', event: 'e', index: 0 }, axis: 1, colour: 0 }],
    });
  });
});

const happening = (number: number, more: Partial<Happening> = {}): Happening => ({
  number,
  t: number / 10,
  wall: 1000 + number,
  kind: 'event',
  node: 1,
  source: 'drive',
  name: 'steer',
  args: [number],
  text: '',
  ...more,
});

describe('happenings', () => {
  test('AFilterTakesWordsNodesAndKindsAndRefusesWithAMinus', () => {
    const items = [
      happening(1),
      happening(2, { name: 'alive' }),
      happening(3, { kind: 'gone', node: 2, source: 'range', name: '' }),
    ];
    const numbers = (part: object) =>
      items.filter(passes({ ...allEvents, ...part })).map((item) => item.number);
    expect(numbers({ find: 'drive -alive' })).toEqual([1]);
    expect(numbers({ node: 2 })).toEqual([3]);
    expect(numbers({ kinds: ['event'] })).toEqual([1, 2]);
    expect(numbers({ find: 'drive -' })).toEqual([1, 2]);
  });
  test('OnlyWhatIsNewIsTested', () => {
    const filtered = new Filtered();
    const passesAll = vi.fn(() => true);
    const first = [happening(1), happening(2)];
    filtered.of(first, passesAll);
    const shown = filtered.of([...first.slice(1), happening(3)], passesAll);
    expect(passesAll).toHaveBeenCalledTimes(3);
    expect(shown.map((item) => item.number)).toEqual([2, 3]);
  });
  test('EachRowOfTheTableHasTheSameColumnsAndItsRun', () => {
    const csv = happeningsCsv([
      happening(1, { run: 3, args: [5, -6] }),
      happening(2, { run: 4, args: [] }),
    ]);
    expect(csv.split('\r\n')).toEqual([
      'run,time,wall,kind,node,source,name,text,args',
      '3,0.1,1970-01-01T00:00:01.001Z,event,1,drive,steer,,5 -6',
      '4,0.2,1970-01-01T00:00:01.002Z,event,1,drive,steer,,',
      '',
    ]);
  });

  const open = () => {
    const world = new TestWorld();
    const connection = new Connection(world, { token: '', client: 'c', now: () => 0 });
    connection.start();
    world.welcome();
    const happenings = new Happenings(connection, world);
    const say = (items: Happening[], left = 0) => world.say({ watch: 1, items, left_out: left });
    return { world, happenings, say };
  };
  test('WhatComesTwiceIsShownOnceAndLossesAreCounted', () => {
    const { happenings, say } = open();
    const each = vi.fn();
    happenings.follow(each);
    say([happening(1), happening(2)]);
    say([happening(2), happening(3)], 4);
    expect(happenings.items.map((item) => item.number)).toEqual([1, 2, 3]);
    expect(happenings.leftOut).toBe(4);
    expect(each.mock.calls.map(([items]) => (items as Happening[]).length)).toEqual([2, 1]);
    expect(happenings.countList()[0]).toMatchObject({ name: 'steer', count: 3, rate: 10 });
  });
  test('WhatWasClearedDoesNotComeBackButAServerThatWasRestartedIsHeard', () => {
    const { world, happenings, say } = open();
    const restart = (epoch: string) => {
      world.last.events.closed();
      world.pass(1000);
      world.welcome(7, { epoch });
    };
    happenings.follow();
    say([happening(5)]);
    happenings.clear();
    say([happening(5), happening(6)]);
    expect(happenings.items.map((item) => item.number)).toEqual([6]);
    restart('f');
    say([happening(0)]);
    expect(happenings.items.map((item) => item.number)).toEqual([0]);
    happenings.clear();
    restart('g');
    say([happening(0)]);
    expect(happenings.items.map((item) => item.number)).toEqual([0]);
  });
  test('NoMoreAreKeptThanThePageTakes', () => {
    const { happenings, say } = open();
    happenings.follow();
    say(Array.from({ length: kHappeningsMax + 5 }, (_, index) => happening(index)));
    expect(happenings.items).toHaveLength(kHappeningsMax);
    expect(happenings.items[0]?.number).toBe(5);
  });
  test('TheSubscriptionEndsAMomentAfterTheLastLooker', () => {
    const { world, happenings } = open();
    happenings.follow()();
    const sent = () => world.last.sent.map((one) => one.do);
    expect(sent()).not.toContain('unwatch');
    world.pass(5000);
    expect(sent()).toContain('unwatch');
  });
});

describe('words on the screen', () => {
  const open = () => {
    const world = new TestWorld();
    let now = 0;
    const studio = new Studio(
      world,
      { client: 'c', nonce: 'n', renamed: () => {}, firstId: 1, usedId: () => {} },
      '',
      () => now,
    );
    studio.connection.start();
    world.welcome();
    const frame = (watch: number, address: number, values: number[]) => {
      const view = new DataView(new ArrayBuffer(20 + values.length * 2));
      view.setUint8(0, 1);
      view.setUint32(4, watch, true);
      view.setUint16(16, address, true);
      view.setUint16(18, values.length, true);
      values.forEach((value, index) => view.setInt16(20 + index * 2, value, true));
      world.last.events.bytes(view.buffer);
    };
    const pass = (ms: number) => {
      for (let step = 0; step < ms; step += 10) {
        now += 10;
        world.pass(10);
      }
    };
    const watches = () => world.last.sent.filter((one) => one.in['topic'] === 'variables');
    return { studio, frame, pass, watches };
  };
  const at = (first: number, count = 1) => ({ node: 1, address: 0, size: 4, first, count });
  test('RowsOfOneNodeAreAskedTogetherOnceTheyHaveSettled', () => {
    const { studio, pass, watches } = open();
    studio.words.look(at(0), () => {});
    studio.words.look(at(2), () => {});
    studio.words.look({ node: 1, address: 9, size: 1, first: 9, count: 1 }, () => {});
    expect(watches()).toEqual([]);
    pass(kSettleMs);
    expect(watches().map((one) => one.in['of'])).toEqual([
      { node: 1, ranges: [[0, 4], [9, 1]] }, // prettier-ignore
    ]);
  });
  test('AChangedWordIsMarkedForASecondAndTheFirstOneIsNoChange', () => {
    const { studio, frame, pass, watches } = open();
    const seen: Seen[] = [];
    studio.words.look(at(1), (one) => seen.push(one));
    pass(kSettleMs);
    const watch = Number(watches()[0]?.in['watch']);
    frame(watch, 0, [1, 2, 3, 4]);
    pass(20);
    expect(seen.at(-1)).toMatchObject({ values: [2], changed: [false] });
    frame(watch, 0, [1, 5, 3, 4]);
    frame(watch, 0, [1, 6, 3, 4]);
    pass(20);
    expect(seen.at(-1)).toMatchObject({ values: [6], changed: [true] });
    expect(seen).toHaveLength(3); // two frames before one painting are told once
    pass(kMarkMs * 1.5);
    expect(seen.at(-1)).toMatchObject({ values: [6], changed: [false] });
  });
  test('OnlyRowsWhoseWordsChangedAreTold', () => {
    const { studio, frame, pass, watches } = open();
    const other = vi.fn();
    studio.words.look(at(3), other);
    pass(kSettleMs);
    const watch = Number(watches()[0]?.in['watch']);
    frame(watch, 0, [1]);
    pass(20);
    expect(other).toHaveBeenCalledTimes(1);
  });
  test('ANodeThatStandsKeepsItsMarksAndSaysWhatWasBefore', () => {
    const { studio, frame, pass, watches } = open();
    const seen: Seen[] = [];
    studio.words.look(at(0), (one) => seen.push(one));
    pass(kSettleMs);
    const watch = Number(watches()[0]?.in['watch']);
    frame(watch, 0, [7]);
    studio.words.pause(1, true);
    studio.words.pause(1, false);
    frame(watch, 0, [8]);
    pass(50);
    studio.words.pause(1, true);
    pass(kMarkMs * 3);
    expect(seen.at(-1)).toEqual({ values: [8], changed: [true], before: [7] });
  });
  test('WhenNoRowLooksNothingIsAsked', () => {
    const { studio, pass, watches } = open();
    const end = studio.words.look(at(0), () => {});
    pass(kSettleMs);
    end();
    pass(kSettleMs * 2);
    expect(watches()).toHaveLength(1);
  });
  test('ElementsShareTheRangeOfTheirVariable', () => {
    expect(rangesOf([at(0), at(1), { ...at(5), address: 5, size: 1 }])).toEqual([
      [0, 4],
      [5, 1],
    ]);
  });
});

describe('plots follow the server', () => {
  const setUp = () => {
    const world = new TestWorld();
    let now = 0;
    const studio = new Studio(
      world,
      { client: 'c', nonce: 'n', renamed: () => {}, firstId: 1, usedId: () => {} },
      '',
      () => now,
    );
    studio.connection.start();
    world.welcome();
    const watchOf = (topic: string) =>
      Number(world.last.sent.filter((one) => one.in['topic'] === topic).at(-1)?.in['watch']);
    const whole = (topic: string, value: object) =>
      world.say({ watch: watchOf(topic), whole: value });
    const clock = (t: number) =>
      whole('clock', { t, wall: 0, state: 'running', speed: 1, real: 1 });
    const samples = (list: [number, number, number][]) => {
      const view = new DataView(new ArrayBuffer(16 + list.length * 12));
      view.setUint8(0, 2);
      view.setUint32(4, watchOf('samples'), true);
      list.forEach(([t, word, value], index) => {
        view.setFloat64(16 + index * 12, t, true);
        view.setUint16(24 + index * 12, word, true);
        view.setInt16(26 + index * 12, value, true);
      });
      world.last.events.bytes(view.buffer);
    };
    const later = (ms: number) => ((now += ms), world.pass(ms));
    return { world, studio, whole, clock, samples, later };
  };
  const source = { is: 'word', pick: { node: 1, name: 'b' } } as const;
  test('VariablesOfThePlanAreCurvesToo', () => {
    const { world, studio, whole, clock } = setUp();
    const rounds = { is: 'word', pick: { node: kPlanNode, name: 'rounds' } } as const;
    studio.plotter.set(withCurve(noPlot, rounds));
    studio.plotter.follow();
    clock(2);
    const level = { path: 'P', doc: 'P.plan.json', actor: 'a', template: 'Wait' };
    const told = (t: number, value: number | boolean) => {
      const variables = [{ name: 'rounds', type: 'int', value, unit: '' }];
      const rest = { activation: 1, since: 0, inputs: {}, variables, supervisors: [], counts: [] };
      whole('plan', { state: 'running', t, levels: [{ ...level, ...rest }], story: [] });
    };
    told(1, 3);
    told(2, true);
    expect(studio.plotter.csv()).toBe('time,plan.rounds\r\n1,3\r\n2,1\r\n');
    // No node is asked for it.
    expect(world.last.sent.some((one) => one.in['topic'] === 'node')).toBe(false);
  });
  test('NamesAreAskedAsAddressesAndSamplesLandInTheirCurve', () => {
    const { world, studio, whole, clock, samples } = setUp();
    studio.plotter.set(withCurve(noPlot, source));
    studio.plotter.follow();
    whole('node', {
      name: 'n',
      variables: [variable('a', 0), variable('b', 4)],
      events: [],
      natives: [],
    });
    expect(world.last.sent.findLast((one) => one.in['topic'] === 'samples')?.in['of']).toEqual({
      words: [[1, 4]],
    });
    clock(2);
    samples([
      [1, 0, 10],
      [2, 0, 20],
    ]);
    expect(studio.plotter.csv()).toBe('time,1.b\r\n1,10\r\n2,20\r\n');
    expect(studio.plotter.view()).toEqual({ from: 0, to: 30 });
  });
  test('HeldItShowsWhatItShowedWhileSamplesGoOn', () => {
    const { studio, clock } = setUp();
    studio.plotter.set(withCurve(noPlot, source));
    studio.plotter.follow();
    clock(50);
    studio.plotter.pause(true);
    clock(60);
    expect(studio.plotter.view()).toEqual({ from: 20, to: 50 });
    studio.plotter.pause(false);
    expect(studio.plotter.view()).toEqual({ from: 30, to: 60 });
  });
  test('ARunThatBeginsAnewEmptiesThePlot', () => {
    const { studio, whole, clock, samples } = setUp();
    studio.plotter.set(withCurve(noPlot, source));
    studio.plotter.follow();
    whole('node', { name: 'n', variables: [variable('b', 4)], events: [], natives: [] });
    clock(40);
    samples([[39, 0, 1]]);
    clock(0);
    samples([
      [39.5, 0, 1],
      [0.5, 0, 2],
    ]);
    expect(studio.plotter.rows(9).rows).toEqual([[0.5, 2]]);
  });
});

describe('the network', () => {
  const traffic = [
    { from: 1, event: 'a', count: 10, to: [1, 2, 3] },
    { from: 1, event: 'b', count: 4, to: [2] },
    { from: 0, event: 'c', count: 2, to: [] },
  ];
  test('PairsThatTalkAreOneFlowEach', () => {
    const flows = flowsOf(traffic, (one) => one.count / 2);
    expect(flows).toEqual([
      { from: 1, to: 2, count: 14, rate: 7, events: ['a', 'b'] },
      { from: 1, to: 3, count: 10, rate: 5, events: ['a'] },
      { from: 0, to: kNobody, count: 2, rate: 1, events: ['c'] },
    ]);
    expect(talkOf(traffic, () => 1).get(1)).toMatchObject({ says: 2, hears: 0, said: 14 });
  });
  test('RatesAreOverTheLastSecondsAndBeginAnewWithTheCounts', () => {
    const rates = new Rates();
    const one = (count: number) => [{ from: 1, event: 'a', count, to: [] }];
    rates.take(one(0), 0);
    expect(rates.rateOf({ from: 1, event: 'a', count: 0, to: [] })).toBe(0);
    rates.take(one(20), 2000);
    expect(rates.rateOf({ from: 1, event: 'a', count: 20, to: [] })).toBe(10);
    rates.take(one(5), 3000);
    expect(rates.rateOf({ from: 1, event: 'a', count: 5, to: [] })).toBe(0);
  });
  test('NobodyStandsOnAnother', () => {
    fc.assert(
      fc.property(
        fc.integer({ min: 1, max: 120 }),
        fc.integer({ min: 0, max: 2000 }),
        fc.integer({ min: 0, max: 1400 }),
        (count, width, height) => {
          const ids = Array.from({ length: count }, (_, index) => index + 1);
          const picture = pictureOf(ids, { width, height });
          const spots = [...picture.spots.values()];
          const apart = spots.every((a, index) =>
            spots
              .slice(index + 1)
              .every((b) =>
                count <= kBoxesMax
                  ? Math.abs(a.x - b.x) >= 120 || Math.abs(a.y - b.y) >= 52
                  : Math.hypot(a.x - b.x, a.y - b.y) >= 13,
              ),
          );
          const inside = spots.every(
            ({ x, y }) => x >= 40 && y >= 20 && x <= picture.width - 40 && y <= picture.height - 20,
          );
          expect({ apart, inside }).toEqual({ apart: true, inside: true });
        },
      ),
    );
  });
  test('ArrowsGrowWithTrafficAndEndAtBoxes', () => {
    expect([0, 9, 1e9].map(arrowWidth)).toEqual([1, 2.6, 6]);
    expect(boxGap({ x: 0, y: 0 }, { x: 100, y: 0 })).toBe(54);
    expect(boxGap({ x: 0, y: 0 }, { x: 0, y: -100 })).toBe(20);
  });
});
