import { expect, test } from 'vitest';
import { Connection } from './connection';
import { kPostAgainMs, Stopping } from './stopping';
import { TestWorld } from './test_world';

const settle = () => new Promise((done) => setTimeout(done));

function begin() {
  const world = new TestWorld();
  const connection = new Connection(world, { token: 't0ken', client: 'tab', now: () => 0 });
  connection.start();
  return { world, connection, stopping: new Stopping(connection, world) };
}

const stops = (world: TestWorld) => world.last.sent.filter((one) => one.do === 'stop');

test('stop is sent as a command and as a request', async () => {
  const { world, stopping } = begin();
  world.welcome();
  const answer = stopping.press();
  expect(stops(world)).toHaveLength(1);
  expect(world.posts.map(({ path, token }) => [path, token])).toEqual([['stop?client=7', 't0ken']]);
  world.say({ id: stops(world)[0]?.id, ok: { stood: [1], nodes: [] } });
  expect((await answer).stood).toEqual([1]);
  expect(stopping.waits).toBe(false);
});

test('while the server does not answer, the request is repeated every second', async () => {
  const { world, stopping } = begin();
  world.welcome();
  void stopping.press();
  for (let turn = 1; turn <= 3; turn++) {
    expect(world.posts).toHaveLength(turn);
    world.posts.at(-1)?.lost();
    await settle();
    expect(stopping.waits).toBe(true);
    world.pass(kPostAgainMs);
  }
  world.posts.at(-1)?.delivered();
  await settle();
  expect(stopping.waits).toBe(false);
  world.pass(10 * kPostAgainMs);
  expect(world.posts).toHaveLength(4);
});

test('an unanswered stop is sent again on a new connection', () => {
  const { world, stopping } = begin();
  world.welcome();
  void stopping.press();
  world.last.events.closed();
  world.pass(10_000);
  world.welcome();
  expect(stops(world)).toHaveLength(1);
  expect(stopping.waits).toBe(true);
});
