import { describe, expect, test, vi } from 'vitest';
import type { Commands, Json, JsonStep } from '../protocol/messages';
import { CommandError } from './connection';
import { isSame, JsonDocument } from './json_document';
import { applySteps } from './json_steps';
import { shownLevel, typedValue } from './plan_view';

type Answer = Commands['doc.patch']['out'];

/** A server that answers when it is told to. */
class Server {
  value: Json = { a: 1, list: [1] };
  version = 1;
  waiting: { steps: JsonStep[]; done: (answer: Answer) => void; failed: (why: Error) => void }[] =
    [];
  edited: string[] = [];
  /** As a person wrote it; what is patched is written in the server's own form. */
  typed: string | null = null;
  readonly link = {
    edit: (_version: number, changes: { from: number; to: number; text: string }[]) => {
      let text = this.text;
      for (const one of [...changes].reverse())
        text = text.slice(0, one.from) + one.text + text.slice(one.to);
      this.edited.push(text);
      this.typed = text;
      this.value = JSON.parse(text) as Json;
      return Promise.resolve({ version: ++this.version });
    },
    open: () =>
      Promise.resolve({
        text: this.text,
        version: this.version,
        language: 'world' as const,
        unsaved: true,
      }),
    patch: (_version: number, steps: JsonStep[]) =>
      new Promise<Answer>((done, failed) => this.waiting.push({ steps, done, failed })),
  };
  get text() {
    return this.typed ?? JSON.stringify(this.value);
  }
  async answer() {
    const one = this.waiting.shift();
    this.typed = null;
    this.value = applySteps(this.value, one?.steps ?? []).value;
    one?.done({ version: ++this.version, text: this.text });
    await Promise.resolve();
    await Promise.resolve();
  }
  async refuse() {
    this.waiting
      .shift()
      ?.failed(new CommandError({ code: 'conflict', what: 'Somebody was first.' }));
    for (let turn = 0; turn < 5; turn++) await Promise.resolve();
  }
  topic() {
    return { version: this.version, text: this.text, unsaved: true, by: 2, gone: false };
  }
}

const set = (name: string, value: Json): JsonStep[] => [{ do: 'set', at: [name], value }];
const made = () => {
  const server = new Server();
  return {
    server,
    file: new JsonDocument(server.link, { text: server.text, version: server.version }),
  };
};

describe('a JSON file that is edited', () => {
  test('UndoAndRedoLeadToTheTextsThatThereWereByteForByte', async () => {
    const server = new Server();
    const written = '{ "list": [1.0],\n"a": 1 }';
    server.typed = written;
    server.value = JSON.parse(written) as Json;
    const file = new JsonDocument(server.link, { text: written, version: 1 });
    file.commit(set('a', 2));
    await server.answer();
    expect(server.text).toBe('{"list":[1],"a":2}');
    file.undo();
    await file.flushed();
    expect(server.edited).toEqual([written]);
    expect(file.value).toEqual({ list: [1], a: 1 });
    file.redo();
    await file.flushed();
    expect(file.value).toEqual({ list: [1], a: 2 });
    expect(server.edited).toEqual([written, '{"list":[1],"a":2}']);
  });

  test('AChangeShowsAtOnceAndTheNextWaitsForItsAnswer', async () => {
    const { server, file } = made();
    file.commit(set('a', 2));
    file.commit(set('a', 3));
    expect(file.value).toMatchObject({ a: 3 });
    expect(server.waiting).toHaveLength(1);
    await server.answer();
    expect(server.waiting).toHaveLength(1);
    await server.answer();
    expect(server.value).toMatchObject({ a: 3 });
  });
  test('UndoAndRedoTellTheServer', async () => {
    const { server, file } = made();
    file.commit(set('a', 2));
    await server.answer();
    file.undo();
    await server.answer();
    expect(server.value).toMatchObject({ a: 1 });
    file.redo();
    await server.answer();
    expect(server.value).toMatchObject({ a: 2 });
    expect(file.canRedo).toBe(false);
  });
  test('ARowOfKeysIsTakenBackByOneUndoAndAPauseEndsIt', async () => {
    const { server, file } = made();
    const key = (name: string, value: Json, at: number) =>
      file.commit(set(name, value), { of: 'keys', at });
    key('a', 2, 5000);
    key('a', 3, 5900);
    key('b', 'new', 6899);
    key('a', 4, 7899);
    file.undo();
    expect(file.value).toMatchObject({ a: 3, b: 'new' });
    file.undo();
    expect(file.value).toMatchObject({ a: 1 });
    expect(file.value).not.toHaveProperty('b');
    expect(file.canUndo).toBe(false);
    file.redo();
    expect(file.value).toMatchObject({ a: 3, b: 'new' });
    while (server.waiting.length > 0) await server.answer();
    expect(server.value).toMatchObject({ a: 3, b: 'new' });
  });
  test('KeysOfAnotherRowAndKeysAfterAnUndoAreChangesOfTheirOwn', () => {
    const { file } = made();
    file.commit(set('a', 2), { of: 'one', at: 10 });
    file.commit(set('a', 3), { of: 'other', at: 20 });
    file.undo();
    expect(file.value).toMatchObject({ a: 2 });
    file.commit(set('a', 5), { of: 'one', at: 30 });
    file.undo();
    expect(file.value).toMatchObject({ a: 2 });
  });
  test('WhatOthersDidReplacesTheValue', async () => {
    const { server, file } = made();
    server.value = { a: 9, list: [] };
    server.version = 5;
    file.told(server.topic());
    expect(file.value).toEqual({ a: 9, list: [] });
    expect(file.canUndo).toBe(false);
    await server.refuse();
  });
  test('WhatWasToldWhileOursWasUnderWayIsNotTakenTwice', async () => {
    const { server, file } = made();
    file.commit(set('a', 2));
    const [first] = server.waiting;
    server.value = applySteps(server.value, first?.steps ?? []).value;
    server.version = 2;
    file.told(server.topic());
    first?.done({ version: 2, text: server.text });
    await file.flushed();
    expect(file.canUndo).toBe(true);
  });
  test('AConflictTakesTheTextOfTheServerAndSaysSo', async () => {
    const { server, file } = made();
    const trouble = vi.fn();
    file.trouble.on(trouble);
    server.value = { a: 7, list: [1] };
    server.version = 4;
    file.commit(set('a', 2));
    await server.refuse();
    expect(file.value).toMatchObject({ a: 7 });
    expect(trouble).toHaveBeenCalledWith('Somebody was first.');
  });
  test('ATextThatIsNoJsonIsNotEdited', () => {
    const { server, file } = made();
    file.told({ ...server.topic(), version: 2, text: '{ "a": ' });
    expect(file.broken).not.toBeNull();
    file.commit(set('a', 2));
    expect(server.waiting).toHaveLength(0);
    file.told({ ...server.topic(), version: 3, text: '{ "a": 4 }' });
    expect(file.broken).toBeNull();
    expect(file.value).toEqual({ a: 4 });
  });
  test('TheOrderOfNamesDoesNotMatter', () => {
    expect(isSame({ a: 1, b: [2, { c: 3 }] }, { b: [2, { c: 3 }], a: 1 })).toBe(true);
    expect(isSame({ a: 1 }, { a: 1, b: 2 })).toBe(false);
    expect(isSame([1, 2], [2, 1])).toBe(false);
    expect(isSame({ a: undefined as unknown as Json }, { b: 1 })).toBe(false);
  });
});

describe('a plan that runs', () => {
  const level = (path: string, doc: string) => ({
    path,
    doc,
    actor: '',
    template: '',
    activation: 0,
    since: 0,
    inputs: {},
    variables: [],
    supervisors: [],
    counts: [],
  });
  test('TheLevelOfTheDocumentIsShownUnlessAnotherIsChosen', () => {
    const levels = [level('A', 'a.plan.json'), level('A/b', 'b.plan.json')];
    expect(shownLevel(levels, 'a.plan.json', null)).toBe(0);
    expect(shownLevel(levels, 'c.plan.json', null)).toBe(1);
    expect(shownLevel(levels, 'a.plan.json', 'A/b')).toBe(1);
    expect(shownLevel([], 'a.plan.json', 'A')).toBe(-1);
  });
  test('WhatIsTypedMustFitTheType', () => {
    expect(typedValue('float', ' 1,5 ')).toBe(1.5);
    expect(typedValue('float', '')).toBeUndefined();
    expect(typedValue('int', '1.5')).toBeUndefined();
    expect(typedValue('int', '-7')).toBe(-7);
    expect(typedValue('bool', 'yes')).toBeUndefined();
    expect(typedValue('string', ' a')).toBe(' a');
    expect(typedValue('object', '{}')).toBeUndefined();
  });
});
