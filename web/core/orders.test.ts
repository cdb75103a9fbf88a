import { expect, test } from 'vitest';
import { Connection } from './connection';
import { Orders } from './orders';
import { Stopping } from './stopping';
import { TestWorld } from './test_world';

const settle = () => new Promise((done) => setTimeout(done));

function begin() {
  const world = new TestWorld();
  const time = { own: 0 };
  const connection = new Connection(world, { token: 't0ken', client: 'tab', now: () => time.own });
  connection.start();
  const stopping = new Stopping(connection, world);
  const orders = new Orders(connection, stopping);
  world.welcome();
  const sent: string[] = [];
  const ask = (name: string, ready: Promise<unknown> = Promise.resolve()) =>
    orders.ask(ready, async () => {
      sent.push(name);
      return Promise.resolve(name);
    });
  return { world, time, connection, stopping, orders, sent, ask };
}

function later() {
  let done = () => {};
  const ready = new Promise<void>((resolve) => (done = resolve));
  return { ready, done };
}

test('what is asked for while something waits is sent behind it', async () => {
  const { sent, ask } = begin();
  const texts = later();
  const run = ask('run', texts.ready);
  const pause = ask('pause');
  await settle();
  expect(sent).toEqual([]);
  texts.done();
  expect([await run, await pause]).toEqual(['run', 'pause']);
  expect(sent).toEqual(['run', 'pause']);
});

test('what has waited is due when it was due at the key press', async () => {
  const { world, time, connection, orders } = begin();
  world.say({ ping: 1, now: 10_000 });
  const texts = later();
  const run = orders.ask(texts.ready, (_, due) => {
    void connection.send('run.start', {}, due);
    return Promise.resolve();
  });
  time.own = 2500;
  texts.done();
  await run;
  expect(world.last.sent.at(-1)).toMatchObject({ do: 'run.start', until: 13_000 });
});

test('an answer that takes long holds nothing up', async () => {
  const { orders, sent, ask } = begin();
  void orders.ask(Promise.resolve(), () => new Promise(() => {}));
  expect(await ask('pause')).toBe('pause');
  expect(sent).toEqual(['pause']);
});

test('what cannot be sent holds nothing up, and keeps the order of the rest', async () => {
  const { sent, ask } = begin();
  const texts = later();
  const first = ask('first', texts.ready);
  await expect(ask('refused', Promise.reject(new Error('no')))).rejects.toThrow('no');
  const last = ask('last');
  await settle();
  expect(sent).toEqual([]);
  texts.done();
  await Promise.all([first, last]);
  expect(sent).toEqual(['first', 'last']);
});

test('Stop drops what has not been sent, and nothing that is asked for after it', async () => {
  const { stopping, sent, ask } = begin();
  const texts = later();
  const run = ask('run', texts.ready);
  const step = ask('step');
  void stopping.press();
  expect(await run).toBeNull();
  expect(await step).toBeNull();
  expect(await ask('again')).toBe('again');
  texts.done();
  await settle();
  expect(sent).toEqual(['again']);
});

test('Stop in another page drops what has not been sent, and says so', async () => {
  const { world, sent, ask } = begin();
  const texts = later();
  const run = ask('run', texts.ready);
  world.say({ ping: 1, now: 0, stops: 1 });
  await expect(run).rejects.toThrow('Not done: somebody else pressed Stop meanwhile.');
  texts.done();
  expect(await ask('again')).toBe('again');
  expect(sent).toEqual(['again']);
});

test('what is sent says of how many Stops its page had heard', () => {
  const { world, connection } = begin();
  world.say({ ping: 1, now: 0, stops: 4 });
  void connection.send('run.start', {}).catch(() => {});
  expect(world.last.sent.at(-1)).toMatchObject({ do: 'run.start', stops: 4 });
});

test('what has not been sent when the connection is lost is never sent', async () => {
  const { world, sent, ask } = begin();
  const texts = later();
  const run = ask('run', texts.ready);
  world.last.events.closed();
  await expect(run).rejects.toThrow('Not sent: the connection to the server was lost.');
  world.pass(10_000);
  world.welcome();
  texts.done();
  await settle();
  expect(sent).toEqual([]);
});
