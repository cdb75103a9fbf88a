import { describe, expect, test } from 'vitest';
import { Connection, kSilentMs } from './connection';
import { Documents, kStayMs } from './documents';
import { TestWorld } from './test_world';
import { TopicCache } from './topics';

/** Open files of a page whose server is the test; it calls the page 7. */
function make() {
  const world = new TestWorld();
  const connection = new Connection(world, { token: '', client: 'c', now: () => 0 });
  const later = (ms: number, act: () => void) => world.later(ms, act);
  const documents = new Documents(connection, new TopicCache(connection, later), {
    later,
    now: () => 0,
    page: 'p',
  });
  connection.start();
  world.welcome();
  const last = (command: string) => world.last.sent.findLast((one) => one.do === command);
  const answer = async (command: string, ok: unknown) => {
    world.say({ id: last(command)?.id, ok });
    await settled();
  };
  const refuse = async (command: string, what: string, code = 'bad_input') => {
    world.say({ id: last(command)?.id, error: { code, what } });
    await settled();
  };
  const enter = async (doc: string, text = 'abc') => {
    const { opened, release } = documents.acquire(doc);
    const more = { language: 'text', unsaved: false, ends: 'lf' };
    await answer('doc.open', { epoch: 'e', text, version: 1, ...more });
    const { session } = await opened;
    const type = (insert: string) => session.type({ changes: { from: 0, insert }, at: 0 });
    return { session, type, release };
  };
  const tell = async (doc: string, state: object) => {
    const { watch } = world.last.sent.findLast((one) => isWatchOf(one, doc))?.in ?? {};
    const still = { language: 'text', ends: 'lf', unsaved: false, by: '', disk: false };
    world.say({ watch, whole: { epoch: 'e', version: 1, gone: false, ...still, ...state } });
    await settled();
  };
  return { world, documents, last, answer, refuse, enter, tell };
}

const isWatchOf = (one: { do: string; in: Record<string, unknown> }, doc: string) =>
  one.do === 'watch' && JSON.stringify(one.in['of']) === JSON.stringify({ doc });

const settled = async () => {
  for (let turn = 0; turn < 3; turn++) await new Promise((resolve) => setTimeout(resolve));
};

describe('a file that gets another name', () => {
  test('KeepsItsSessionAndIsSavedUnderTheNewOne', async () => {
    const { documents, last, answer, enter } = make();
    const { session, type } = await enter('a');
    type('x');
    documents.renamed('a', 'b');
    await answer('doc.edit', { version: 2 });
    type('y');
    const flushed = documents.flushOne('b');
    expect(last('doc.edit')?.in).toMatchObject({ doc: 'b', version: 2 });
    await answer('doc.edit', { version: 3 });
    await flushed;
    expect((await documents.acquire('b').opened).session).toBe(session);
  });
  test('FollowsWhatTheServerSaysOfIt', async () => {
    const { documents, enter, tell } = make();
    const moved: object[] = [];
    documents.moved.on((one) => moved.push(one));
    const { session } = await enter('a');
    await tell('a', { moved: 'b' });
    expect(moved).toEqual([{ from: 'a', to: 'b' }]);
    expect((await documents.acquire('b').opened).session).toBe(session);
  });
  // What was seen: renamed and back within half a second, each name leads to the other for ever.
  test('MayHaveItsOldNameAgainAtOnce', async () => {
    const { documents, enter, tell } = make();
    const { session } = await enter('a');
    await tell('a', { moved: 'b' });
    await tell('b', { moved: 'a' });
    await tell('a', {});
    await tell('a', { moved: 'b' });
    expect((await documents.acquire('b').opened).session).toBe(session);
  });
  test('TakesThePlaceOfWhatWasOpenUnderItUnlessThatIsUnsent', async () => {
    const { documents, enter } = make();
    await enter('b');
    const a = await enter('a');
    documents.renamed('a', 'b');
    expect((await documents.acquire('b').opened).session).toBe(a.session);
    a.type('unsent');
    await enter('c');
    documents.renamed('c', 'b');
    expect((await documents.acquire('b').opened).session).toBe(a.session);
  });
});

describe('what was typed', () => {
  test('IsTakenFromFieldsBeforeItIsSent', async () => {
    const { documents, last, answer, enter } = make();
    const { type } = await enter('a');
    const end = documents.fields.add({ doc: null, settle: () => (type('typed'), end(), true) });
    const flushed = documents.flushAll();
    expect(last('doc.edit')?.in['changes']).toEqual([{ from: 0, to: 0, text: 'typed' }]);
    await answer('doc.edit', { version: 2 });
    expect(await flushed).toEqual(new Map([['a', 2]]));
    expect(documents.isUnsent).toBe(false);
  });
  test('AndIsRefusedStaysAndIsAskedFor', () => {
    const { documents } = make();
    documents.fields.add({ doc: 'a', settle: () => false });
    expect(documents.fields.settle()).toBe(false);
    expect(documents.isUnsent).toBe(true);
    expect([documents.waits('a'), documents.waits('b')]).toEqual([true, false]);
  });
  test('InAnotherFileIsNoReasonNotToSaveThisOne', async () => {
    const { documents, answer, refuse, enter } = make();
    const a = await enter('a');
    await enter('b');
    a.type('x');
    await refuse('doc.edit', 'Too long.');
    await answer('doc.pull', { version: 1, epoch: 'e', text: 'abc' });
    await refuse('doc.edit', 'Too long.');
    expect(documents.problemOf('a')?.what).toBe('Too long.');
    await documents.flushOne('b');
    expect(documents.waits('b')).toBe(false);
    expect(documents.isUnsent).toBe(true);
  });
  test('EndsAsDisconnectedAlsoWhereTheServerIsOnlySilent', async () => {
    const { world, documents, enter } = make();
    const { type } = await enter('a');
    type('x');
    const flushed = documents.flushAll();
    world.pass(kSilentMs);
    await expect(flushed).rejects.toThrow('no connection');
  });
  test('StaysInThePageWhenTheProjectIsClosedAndGoesOnWhenItIsOpenedAgain', async () => {
    const { documents, last, answer, refuse, enter, tell } = make();
    const { session, type } = await enter('a');
    await enter('clean');
    type('x');
    await refuse('doc.edit', 'No project is open.', 'unavailable');
    const sent = last('doc.edit')?.id;
    expect(documents.leave('/one')).toEqual(['a']);
    expect(documents.isUnsent).toBe(false);
    expect(documents.hasLeft).toBe(true);
    documents.enter('/two');
    expect(documents.isUnsent).toBe(false);
    documents.leave('/two');
    documents.enter('/one');
    expect(documents.hasLeft).toBe(false);
    expect((await documents.acquire('a').opened).session).toBe(session);
    await answer('doc.edit', { version: 1, epoch: 'f', text: 'abc' });
    await tell('a', { epoch: 'f' });
    expect(last('doc.edit')).toMatchObject({ in: { epoch: 'f', version: 1, doc: 'a' } });
    expect(last('doc.edit')?.id).not.toBe(sent);
    await answer('doc.edit', { version: 2 });
    expect(documents.isUnsent).toBe(false);
  });
});

describe('what the server changes because it was asked', () => {
  test('NamesTheTextsThatThisPageHas', async () => {
    const { world, documents, answer, enter, tell } = make();
    const a = await enter('a');
    await enter('gone');
    await tell('gone', { version: 0, gone: true });
    const left = await enter('left');
    left.release();
    world.pass(kStayMs);
    world.say({ ping: 1, now: 0 });
    a.type('x');
    const seen = documents.seen();
    await answer('doc.edit', { version: 2 });
    expect(await seen).toEqual([{ doc: 'a', epoch: 'e', version: 2 }]);
    expect(await documents.seen('a')).toEqual([{ doc: 'a', epoch: 'e', version: 2 }]);
  });
  test('IsTakenBackFirst', async () => {
    const { answer, enter, tell } = make();
    const { session, type } = await enter('a');
    type('# ');
    await answer('doc.edit', { version: 2 });
    await tell('a', { version: 3 });
    const changes = [{ from: 2, to: 5, text: 'renamed' }];
    await answer('doc.pull', { version: 3, behind: [{ version: 3, by: 'for:7', changes }] });
    expect(session.text).toBe('# renamed');
    session.undo();
    expect(session.text).toBe('# abc');
  });
  test('OfAnotherPageIsNot', async () => {
    const { answer, enter, tell } = make();
    const { session } = await enter('a');
    await tell('a', { version: 2 });
    const changes = [{ from: 0, to: 3, text: 'renamed' }];
    await answer('doc.pull', { version: 2, behind: [{ version: 2, by: 'for:8', changes }] });
    expect(session.canUndo).toBe(false);
  });
});

test('AFileThatIsNotOnDiskIsSaidToBe', async () => {
  const { documents, enter, tell } = make();
  const { release } = await enter('a');
  await tell('a', { version: 0, gone: true });
  expect(documents.isGone).toBe(true);
  release();
  expect(documents.isGone).toBe(false);
});
