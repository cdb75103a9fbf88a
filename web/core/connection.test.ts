import { expect, test } from 'vitest';
import { limits } from '../protocol/messages';
import { answers, Connection, kFirstRetryMs, kSilentMs } from './connection';
import { TestWorld } from './test_world';

function make(firstId = 1) {
  const world = new TestWorld();
  const renamed: string[] = [];
  const time = { own: 0 };
  const connection = new Connection(world, {
    token: 'secret',
    client: 'me',
    nonce: 'load',
    firstId,
    renamed: (client) => renamed.push(client),
    now: () => 0,
    clock: () => time.own,
  });
  connection.start();
  return { world, connection, renamed, time };
}

const settled = () => new Promise((resolve) => setTimeout(resolve));

test('APageThatHadControlSaysSoWhenItComesBack', () => {
  const world = new TestWorld();
  let hasControl = false;
  const hadControl = () => hasControl;
  new Connection(world, { token: '', client: 'me', hadControl, now: () => 0 }).start();
  world.welcome();
  expect(world.last.sent[0]?.in).not.toHaveProperty('had_control');
  hasControl = true;
  world.last.events.closed();
  world.pass(kFirstRetryMs);
  world.last.events.open();
  expect(world.last.sent[0]?.in).toHaveProperty('had_control', true);
});

test('HelloIsTheFirstMessageAndNothingGoesBeforeItsAnswer', () => {
  const { world, connection } = make();
  void connection.send('stop', {});
  world.last.events.open();
  expect(world.last.sent.map((one) => one.do)).toEqual(['hello']);
  const hello = world.last.sent[0];
  expect(hello?.in).toMatchObject({ token: 'secret', client: 'me' });
  world.say({
    id: hello?.id,
    ok: {
      version: 'test',
      epoch: 'e',
      client: 'me',
      role: 'drive',
      number: 7,
      driver: true,
      now: 0,
      wall: 0,
    },
  });
  expect(world.last.sent.map((one) => one.do)).toEqual(['hello', 'stop']);
});

test('AnUnansweredCommandIsRepeatedWithItsNumberAfterALostConnection', async () => {
  const { world, connection } = make();
  world.welcome();
  const answer = connection.send('stop', {});
  const id = world.last.sent.at(-1)?.id;
  world.last.events.closed();
  expect(connection.link.state).toBe('lost');
  world.pass(kFirstRetryMs * 2);
  expect(world.sockets).toHaveLength(2);
  world.welcome();
  expect(world.last.sent.find((one) => one.do === 'stop')?.id).toBe(id);
  world.say({ id, ok: { stood: [1], nodes: [] } });
  expect(await answer).toEqual({ stood: [1], nodes: [] });
});

test('WithANewTokenAPageComesBackAfterALostConnection', () => {
  const { world, connection } = make();
  world.welcome();
  connection.token = 'another';
  world.last.events.closed();
  world.pass(kFirstRetryMs * 2);
  world.last.events.open();
  expect(world.last.sent[0]?.in).toMatchObject({ token: 'another', client: 'me' });
});

test('AnActHasADeadlineInTheServersTimeAsItWasToldLast', () => {
  const { world, connection, time } = make();
  time.own = 500;
  world.welcome(7, { now: 10_000 });
  time.own = 700;
  void connection.send('node.run', { node: 1 });
  expect(world.last.sent.at(-1)).toMatchObject({ do: 'node.run', until: 13_200 });
  world.say({ ping: 4, now: 20_000 });
  expect(world.last.sent.at(-1)).toEqual({ pong: 4 });
  time.own = 701;
  void connection.send('run.start', {});
  expect(world.last.sent.at(-1)).toMatchObject({ do: 'run.start', until: 23_001 });
  // A ping that was read late does not set the clock back.
  time.own = 5000;
  world.say({ ping: 5, now: 21_000 });
  void connection.send('run.start', {});
  expect(world.last.sent.at(-1)).toMatchObject({ until: 27_300 });
  void connection.send('stop', {});
  expect(world.last.sent.at(-1)).not.toHaveProperty('until');
});

test('AnActIsNeitherSentAgainNorKeptForLater', async () => {
  const { world, connection } = make();
  await expect(connection.send('run.start', {})).rejects.toThrow('not connected');
  world.welcome();
  const run = connection.send('run.start', {});
  const edit = connection.send('driver.leave', {});
  world.last.events.closed();
  await expect(run).rejects.toThrow('not sent again');
  await expect(connection.send('run.start', {})).rejects.toThrow('nothing was sent');
  world.pass(1000);
  world.welcome();
  expect(world.last.sent.map((one) => one.do)).toEqual(['hello', 'driver.leave']);
  world.say({ id: world.last.sent.at(-1)?.id, ok: {} });
  await edit;
});

test('APageTakesTheNameThatTheServerGivesIt', () => {
  const { world, renamed } = make();
  world.welcome();
  expect(world.last.sent[0]?.in).toMatchObject({ client: 'me', nonce: 'load' });
  expect(renamed).toEqual([]);
  world.last.events.closed();
  world.pass(1000);
  world.welcome(8, { client: 'other' });
  expect(renamed).toEqual(['other']);
  world.last.events.closed();
  world.pass(1000);
  world.last.events.open();
  expect(world.last.sent[0]?.in).toMatchObject({ client: 'other', nonce: 'load' });
});

test('AnAnsweredCommandIsNotRepeated', async () => {
  const { world, connection } = make();
  world.welcome();
  const answer = connection.send('driver.leave', {});
  world.say({ id: world.last.sent.at(-1)?.id, ok: {} });
  await answer;
  world.last.events.closed();
  world.pass(1000);
  world.welcome();
  expect(world.last.sent.map((one) => one.do)).toEqual(['hello']);
});

test('NumbersOfCommandsOnlyGoUp', () => {
  const { world, connection } = make(41);
  world.welcome();
  void connection.send('stop', {});
  world.last.events.closed();
  world.pass(1000);
  world.welcome();
  const ids = world.sockets.flatMap((socket) =>
    socket.sent.filter((one) => one.do === 'hello').map((one) => one.id),
  );
  expect(ids[0]).toBe(41);
  expect(ids[1]).toBeGreaterThan(42);
});

test('RetriesWaitLongerAndLongerUpToALimit', () => {
  const { world } = make();
  let waits = 0;
  for (let turn = 0; turn < 10; turn++) {
    world.last.events.closed();
    const before = world.sockets.length;
    for (waits = 0; world.sockets.length === before; waits += 50) world.pass(50);
  }
  expect(waits).toBe(5000);
});

test('SubscriptionsAreRenewedAndPatchesApply', () => {
  const { world, connection } = make();
  world.welcome();
  const values: unknown[] = [];
  connection.watch('state', {}, { value: (value) => values.push(value) });
  const watch = world.last.sent.at(-1)?.in['watch'];
  world.say({ watch, whole: { values: { a: 1 } } });
  world.say({ watch, patch: { values: { b: 2 } } });
  world.last.events.closed();
  world.pass(1000);
  world.welcome();
  expect(world.last.sent.at(-1)).toMatchObject({ do: 'watch', in: { watch, topic: 'state' } });
  world.say({ watch, whole: { values: { c: 3 } } });
  expect(values).toEqual([{ values: { a: 1 } }, { values: { a: 1, b: 2 } }, { values: { c: 3 } }]);
});

test('ADocumentOfAnotherShapeIsNotShown', () => {
  const { world, connection } = make();
  world.welcome();
  const odd: string[] = [];
  const values: unknown[] = [];
  connection.odd.on((what) => odd.push(what));
  connection.watch('files', {}, { value: (value) => values.push(value) });
  world.say({
    watch: world.last.sent.at(-1)?.in['watch'],
    whole: { files: [{ path: 1 }], more: false },
  });
  expect(values).toEqual([]);
  expect(odd).toEqual(['files: files.0.path']);
});

test('AnErrorRejectsWithItsSentence', async () => {
  const { world, connection } = make();
  world.welcome();
  const answer = connection.send('doc.save', { doc: 'a' });
  world.say({
    id: world.last.sent.at(-1)?.id,
    error: { code: 'not_found', what: 'There is no a.' },
  });
  await expect(answer).rejects.toThrow('There is no a.');
});

test('AWrongTokenEndsIt', async () => {
  const { world, connection } = make();
  const answer = connection.send('stop', {});
  world.last.events.open();
  world.say({ id: world.last.sent[0]?.id, error: { code: 'not_allowed', what: 'Wrong token.' } });
  await expect(answer).rejects.toThrow('Wrong token.');
  world.last.events.closed();
  world.pass(60_000);
  expect(world.sockets).toHaveLength(1);
  await settled();
});

test('BinaryFramesReachTheirSubscription', () => {
  const { world, connection } = make();
  world.welcome();
  let got = '';
  connection.watch(
    'variables',
    { node: 1, ranges: [[0, 2]] },
    { frame: (time, payload) => (got = `${time} ${payload.getInt16(4, true)}`) },
  );
  const frame = new DataView(new ArrayBuffer(24));
  frame.setUint8(0, 1);
  frame.setUint32(4, Number(world.last.sent.at(-1)?.in['watch']), true);
  frame.setFloat64(8, 1.5, true);
  frame.setUint16(18, 2, true);
  frame.setInt16(20, -7, true);
  world.last.events.bytes(frame.buffer);
  expect(got).toBe('1.5 -7');
});

test('AfterThreeMissingPingsWhatMovesARobotIsRefusedAndStopIsSent', async () => {
  const { world, connection } = make();
  world.welcome();
  for (let ping = 0; ping < 5; ping++) {
    world.pass(1000);
    world.say({ ping, now: 1000 * ping });
  }
  expect(answers(connection.link)).toBe(true);
  world.pass(kSilentMs);
  expect(answers(connection.link)).toBe(false);
  await expect(connection.send('run.start', {})).rejects.toThrow();
  const sent = world.last.sent.length;
  void connection.send('stop', {});
  void connection.send('driver.leave', {});
  expect(world.last.sent.slice(sent).map((one) => one.do)).toEqual(['stop', 'driver.leave']);
  world.say({ ping: 6, now: 9000 });
  expect(answers(connection.link)).toBe(true);
});

test('ASaveEndsWhenTheConnectionIsLostOrSilentAndIsNotSentAgain', async () => {
  const { world, connection } = make();
  await expect(connection.send('doc.save', { doc: 'a' })).rejects.toThrow('not connected');
  world.welcome();
  const lost = connection.send('doc.save', { doc: 'a' });
  world.last.events.closed();
  await expect(lost).rejects.toThrow('save again');
  world.pass(1000);
  world.welcome();
  expect(world.last.sent.map((one) => one.do)).toEqual(['hello']);
  const silent = connection.send('doc.save_all', {});
  world.pass(kSilentMs);
  await expect(silent).rejects.toThrow('save again');
});

test('AMessageThatIsTooLongIsRefusedHereAndNothingElseIs', async () => {
  const { world, connection } = make();
  world.welcome();
  // {"id":2,"do":"state.put","in":{"key":"k","value":"…"}} is 53 bytes without the value.
  const put = (value: string) => connection.send('state.put', { key: 'k', value });
  const most = limits.message_bytes - 53;
  await expect(put('x'.repeat(most + 1))).rejects.toThrow('more than 4 MiB');
  // Two bytes each.
  await expect(put('é'.repeat(most / 2 + 1))).rejects.toThrow('more than 4 MiB');
  void put('x'.repeat(most - 10));
  void connection.send('driver.leave', {});
  expect(world.last.sent.map((one) => one.do)).toEqual(['hello', 'state.put', 'driver.leave']);
  world.last.events.closed();
  world.pass(1000);
  world.welcome();
  expect(world.last.sent.map((one) => one.do)).toEqual(['hello', 'state.put', 'driver.leave']);
});

test('AnotherLifeOfTheServerIsToldBeforeWhatItSays', () => {
  const { world, connection } = make();
  const told: string[] = [];
  connection.renewed.on(() => told.push('renewed'));
  connection.changed.on((link) => told.push(link.state));
  world.welcome();
  world.last.events.closed();
  world.pass(1000);
  world.welcome();
  world.last.events.closed();
  world.pass(1000);
  world.welcome(7, { epoch: 'f' });
  expect(told).toEqual(['open', 'lost', 'open', 'lost', 'renewed', 'open']);
});
