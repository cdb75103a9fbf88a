import { describe, expect, test, vi } from 'vitest';
import { CommandError } from '../connection';
import { JsonFile } from './json_file';
import { FileSync } from './sync';
import { ModelPage, ModelServer, Schedule } from './test_server';
import { TextSession } from './text_session';
import type { Answer } from './wire';

const set = (name: string, value: number | string) => [{ do: 'set' as const, at: [name], value }];

/** Two pages at one server, whose messages take a millisecond. */
function pair(text: string, language = 'json') {
  const server = new ModelServer(text);
  const schedule = new Schedule();
  const page = (name: string) => new ModelPage(name, server, schedule, () => 1, language);
  return { server, schedule, a: page('A'), b: page('B') };
}

describe('the one history of a file', () => {
  test('StepsOfARowAndLettersWithinASecondAreTakenBackTogether', () => {
    let now = 0;
    const file = new JsonFile(new TextSession('{"a":1}', 'json'), () => now);
    const key = (name: string, value: number, at: number) =>
      file.commit(set(name, value), { of: 'keys', at });
    key('a', 2, 5000);
    key('a', 3, 5900);
    key('b', 9, 6899);
    key('a', 4, 7899);
    file.undo();
    expect(file.value).toEqual({ a: 3, b: 9 });
    file.undo();
    expect(file.value).toEqual({ a: 1 });
    expect(file.canUndo).toBe(false);
    now = 9000;
    file.redo();
    expect(file.value).toEqual({ a: 3, b: 9 });
    const text = new TextSession('', 'text');
    text.type({ changes: { from: 0, insert: 'a' }, at: 0 });
    text.type({ changes: { from: 1, insert: 'b' }, at: 999 });
    text.type({ changes: { from: 2, insert: 'c' }, at: 2000 });
    text.undo();
    expect(text.text).toBe('ab');
    text.undo();
    expect(text.text).toBe('');
  });
  test('ALetterInTheTextBesideDoesNotCutTheUndoOfTheDrawing', () => {
    const session = new TextSession('{ "a" :1,\n"name": "P" }', 'json');
    session.step(set('a', 2), 0);
    session.type({ changes: { from: session.text.indexOf('P'), insert: 'Q' }, at: 5000 });
    session.undo();
    session.undo();
    expect(session.text).toBe('{ "a" :1,\n"name": "P" }');
  });
  test('AFastUndoKeepsTheLinesOfAFileWrittenByHand', async () => {
    const written = '{ "list": [1.0],\n\n"a": 1 }';
    const { server, schedule, a } = pair(written);
    a.session.step(set('a', 2), 0);
    a.session.undo();
    await schedule.advance(100);
    expect(server.text).toBe(written);
  });
});

describe('two who edit one file', () => {
  test('AnothersTextLeavesUndoAndWhatIsUnsentAsTheyAre', async () => {
    const { server, schedule, a, b } = pair('{ "a": 1, "b": 2 }');
    a.session.step(set('a', 7), 0);
    b.session.step(set('b', 8), 0);
    await schedule.advance(100);
    expect(server.text).toBe('{ "a": 7, "b": 8 }');
    a.session.undo();
    await schedule.advance(100);
    expect(server.text).toBe('{ "a": 1, "b": 8 }');
    expect(b.session.text).toBe(server.text);
  });
  test('AStepInAListFollowsItsItem', async () => {
    const { server, schedule, a, b } = pair('{ "list": [5, 7] }');
    a.session.step([{ do: 'remove', at: ['list', 0] }], 0);
    await schedule.advance(1);
    b.session.step([{ do: 'set', at: ['list', 1], value: 9 }], 0);
    await schedule.advance(100);
    expect(JSON.parse(server.text)).toEqual({ list: [9] });
  });
  test('AStepAtWhatAnotherHasRemovedIsRefusedAndSaidSo', async () => {
    const { server, schedule, a, b } = pair('{ "list": [5, 7] }');
    const refused = vi.fn();
    b.session.refused.on(refused);
    a.session.step([{ do: 'remove', at: ['list', 0] }], 0);
    b.session.step([{ do: 'set', at: ['list', 0], value: 6 }], 0);
    await schedule.advance(100);
    expect(JSON.parse(server.text)).toEqual({ list: [7] });
    expect(b.session.text).toBe(server.text);
    expect(refused).toHaveBeenCalledOnce();
  });
  test('TwoWhoAddTheSameMemberLeaveItOnce', async () => {
    const { server, schedule, a, b } = pair('{}');
    a.session.step(set('x', 1), 0);
    b.session.step(set('x', 2), 0);
    await schedule.advance(100);
    expect(server.text.match(/"x"/g)).toHaveLength(1);
    expect(a.session.text).toBe(b.session.text);
  });
  test('UndoOfWhatAnotherHasReplacedSinceLeavesTheirs', async () => {
    const { server, schedule, a, b } = pair('{ "list": [5, 7] }');
    const refused = vi.fn();
    a.session.refused.on(refused);
    a.session.step([{ do: 'set', at: ['list', 0], value: 6 }], 0);
    await schedule.advance(100);
    b.session.step([{ do: 'remove', at: ['list', 0] }], 0);
    await schedule.advance(100);
    a.session.undo();
    await schedule.advance(100);
    expect(JSON.parse(server.text)).toEqual({ list: [7] });
    expect(refused).toHaveBeenCalledOnce();
  });
  test('WhileTheTextIsNoJsonStepsWaitAndNothingElseIsDrawn', async () => {
    const { server, schedule, a, b } = pair('{ "a": 1, "b": 2 }');
    const file = new JsonFile(b.session, () => 0);
    b.cut();
    b.session.step(set('b', 8), 0);
    a.session.type({ changes: { from: 0, to: 1 }, at: 0 });
    await schedule.advance(100);
    b.join();
    await schedule.advance(100);
    expect(file.broken).not.toBeNull();
    expect(file.value).toEqual({ a: 1, b: 8 });
    expect(file.commit(set('a', 5))).toBe(false);
    expect(server.text).toBe(' "a": 1, "b": 2 }');
    a.session.type({ changes: { from: 0, insert: '{' }, at: 0 });
    await schedule.advance(100);
    expect(server.text).toBe('{ "a": 1, "b": 8 }');
    expect(file.value).toEqual({ a: 1, b: 8 });
  });
});

describe('what the server does because it was asked', () => {
  test('UndoTakesItBackBeforeWhatWasTypedEarlierAndRedoDoesItAgain', async () => {
    const { server, schedule, a, b } = pair('var old\n', 'text');
    a.session.type({ changes: { from: 8, insert: '# note' }, at: 0 });
    await schedule.advance(100);
    server.apply('for:A', [{ from: 4, to: 7, text: 'new' }]);
    await schedule.advance(100);
    expect(a.session.text).toBe('var new\n# note');
    a.session.undo();
    await schedule.advance(100);
    expect(server.text).toBe('var old\n# note');
    a.session.redo();
    await schedule.advance(100);
    expect(server.text).toBe('var new\n# note');
    b.session.undo();
    await schedule.advance(100);
    expect(b.session.text).toBe('var new\n# note');
    a.session.undo();
    a.session.undo();
    await schedule.advance(100);
    expect(server.text).toBe('var old\n');
  });
  test('ItIsAStepOfItsOwnAlsoWhileSomethingIsUnderWay', async () => {
    const { server, schedule, a } = pair('var old\n', 'text');
    a.session.type({ changes: { from: 8, insert: '# note' }, at: 0 });
    server.apply('for:A', [{ from: 4, to: 7, text: 'new' }]);
    await schedule.advance(100);
    expect(server.text).toBe('var new\n# note');
    a.session.undo();
    await schedule.advance(100);
    expect(server.text).toBe('var old\n# note');
  });
  test('AfterAllWasReplacedTheTypedTextComesBack', async () => {
    const { server, schedule, a } = pair('abc', 'text');
    a.session.type({ changes: { from: 3, insert: ' typed' }, at: 0 });
    await schedule.advance(100);
    server.apply('for:A', [{ from: 0, to: 9, text: 'disk' }]);
    await schedule.advance(100);
    expect(a.session.text).toBe('disk');
    a.session.undo();
    await schedule.advance(100);
    expect(server.text).toBe('abc typed');
  });
});

describe('a server that was started again', () => {
  test('WhatWasTypedAndNotAnsweredIsMergedOnce', async () => {
    const { server, schedule, a } = pair('abc', 'text');
    a.session.type({ changes: { from: 3, insert: 'X' }, at: 0 });
    // Taken, and the answer lost.
    await schedule.advance(1);
    a.cut();
    a.session.type({ changes: { from: 0, insert: 'Y' }, at: 0 });
    server.restart();
    server.apply('disk', [{ from: 1, to: 1, text: '-' }]);
    a.join();
    await schedule.advance(100);
    expect(server.text).toBe('Ya-bcX');
    expect(a.session.text).toBe(server.text);
  });
  test('WhatWasTypedIsNotTakenForArrivedBecauseAsMuchWasDeleted', async () => {
    const { server, schedule, a } = pair('abcdefgh', 'text');
    a.cut();
    a.session.type({ changes: { from: 4, to: 8, insert: 'XY' }, at: 0 });
    // Shorter by two, so that it is more like any other text; it was never sent.
    server.restart();
    server.apply('disk', [{ from: 0, to: 8, text: 'tuvw' }]);
    a.join();
    await schedule.advance(100);
    expect(server.text).toBe('tuvwXY');
  });
  test('WhatItTookBeforeCountsOnceAlsoIfTheNewOneRefusesIt', async () => {
    const { server, schedule, a } = pair('abc', 'text');
    a.session.type({ changes: { from: 3, insert: 'X' }, at: 0 });
    // Taken, and the answer lost.
    await schedule.advance(1);
    a.cut();
    server.restart();
    server.refuses = 1;
    a.join();
    await schedule.advance(100);
    expect(server.text).toBe('abcX');
    expect(a.session.text).toBe('abcX');
  });
});

describe('waits', () => {
  type Ask = { done: (answer: Answer) => void; failed: (error: unknown) => void };
  const made = () => {
    const session = new TextSession('abc', 'text');
    const edits: Ask[] = [];
    const pulls: Ask[] = [];
    const into = (list: Ask[]) => () =>
      new Promise<Answer>((done, failed) => list.push({ done, failed }));
    const link = { edit: into(edits), pull: into(pulls) };
    const sync = new FileSync(session, { epoch: '1', version: 1 }, link, () => 'me');
    return { session, edits, pulls, sync };
  };
  const turns = async () => {
    for (let turn = 0; turn < 5; turn++) await Promise.resolve();
  };
  test('EndWithTheReasonWhenAnEditIsRefusedAndTheNextOneIsSent', async () => {
    const { session, edits, pulls, sync } = made();
    const problem = { code: 'bad_input' as const, what: 'Too long.' };
    session.type({ changes: { from: 0, insert: 'X' }, at: 0 });
    const wait = sync.flushed();
    edits.shift()?.failed(new CommandError(problem));
    await turns();
    pulls.shift()?.done({ version: 1, epoch: '1', text: 'abc' });
    await turns();
    edits.shift()?.failed(new CommandError(problem));
    expect(await wait).toEqual({ is: 'refused', problem });
    expect(session.text).toBe('Xabc');
    const next = sync.flushed();
    edits.shift()?.done({ version: 2 });
    expect(await next).toEqual({ is: 'sent', epoch: '1', version: 2 });
  });
  test('AnEditThatNobodyKnowsOfIsSentAgainUnderItsNameAndCountsOnce', async () => {
    const { session, edits, sync } = made();
    session.type({ changes: { from: 0, insert: 'X' }, at: 0 });
    const wait = sync.flushed();
    edits.shift()?.failed(new CommandError({ code: 'timeout', what: 'No answer.' }));
    expect(await wait).toMatchObject({ is: 'refused' });
    const next = sync.flushed();
    const taken = { version: 2, by: 'me', changes: [{ from: 0, to: 0, text: 'X' }] };
    edits.shift()?.done({ version: 2, behind: [taken] });
    expect(await next).toMatchObject({ is: 'sent', version: 2 });
    expect(session.text).toBe('Xabc');
    expect(edits).toHaveLength(0);
  });
  test('EndWhenTheConnectionIsLostAndGoOnWhenItIsBack', async () => {
    const { session, edits, sync } = made();
    session.type({ changes: { from: 0, insert: 'X' }, at: 0 });
    const wait = sync.flushed();
    sync.linked(false);
    expect(await wait).toEqual({ is: 'disconnected' });
    expect(await sync.flushed()).toEqual({ is: 'disconnected' });
    sync.linked(true);
    const next = sync.flushed();
    edits.shift()?.done({ version: 2 });
    expect(await next).toMatchObject({ is: 'sent' });
  });
});
