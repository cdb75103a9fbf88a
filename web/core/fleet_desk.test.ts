import { expect, test } from 'vitest';
import type { FleetEvent } from '../protocol/messages';
import { kRobotsAtOnce } from './fleet';
import { FleetDesk, kFleetEventsKept } from './fleet_desk';
import { Studio } from './studio';
import { TestWorld } from './test_world';

const settled = async () => {
  for (let turn = 0; turn < 3; turn++) await new Promise((resolve) => setTimeout(resolve));
};

function make() {
  const world = new TestWorld();
  const identity = { client: 'c', nonce: 'n', firstId: 1, usedId: () => {}, renamed: () => {} };
  const studio = new Studio(world, identity, '', () => 0);
  studio.connection.start();
  world.welcome();
  const desk = new FleetDesk(studio);
  desk.enter('mqtt://broker/lab');
  const sent = (command: string) => world.last.sent.filter((one) => one.do === command);
  const outcomes = (robots: readonly string[], result = 'done') => ({
    outcomes: robots.map((robot) => ({ robot, result, what: '' })),
  });
  return { world, desk, sent, outcomes };
}

const event = (number: number): FleetEvent => ({
  number,
  wall: 0,
  kind: 'event',
  robot: 'r1',
  name: 'alarm',
  args: [],
  text: '',
});

test('AnOrderIsAnsweredWithWhatBecameOfIt', async () => {
  const { world, desk, sent, outcomes } = make();
  const ordered = desk.order('emit', ['r1', 'r2'], { event: 'alarm', values: [3] });
  expect(desk.report).toEqual({ verb: 'emit', robots: 2, is: 'sent' });
  const [order] = sent('fleet.order');
  expect(order?.in).toEqual({ verb: 'emit', robots: ['r1', 'r2'], event: 'alarm', values: [3] });
  world.say({ id: order?.id, ok: outcomes(['r1', 'r2']) });
  await ordered;
  expect(desk.report).toMatchObject({ is: 'answered', ...outcomes(['r1', 'r2']) });
});

test('StopForAllNamesNobody', () => {
  const { desk, sent } = make();
  void desk.order('stop', null);
  expect(sent('fleet.stop').map((one) => one.in)).toEqual([{}]);
  expect(desk.report).toEqual({ verb: 'stop', robots: 'all', is: 'sent' });
});

test('MoreRobotsThanTheServerTakesAreToldInSeveralOrders', async () => {
  const { world, desk, sent, outcomes } = make();
  const robots = Array.from({ length: kRobotsAtOnce + 1 }, (_, at) => `r${at}`);
  const ordered = desk.order('stop', robots);
  const orders = sent('fleet.stop');
  expect(orders).toHaveLength(2);
  for (const order of orders)
    world.say({ id: order.id, ok: outcomes(order.in['robots'] as string[]) });
  await ordered;
  expect(desk.report).toMatchObject({ is: 'answered', ...outcomes(robots) });
});

test('WhyAnOrderWasNotGivenIsInTheReport', async () => {
  const { world, desk, sent } = make();
  const ordered = desk.order('pause', ['r1']);
  const error = { code: 'not_allowed', what: 'the broker does not pass it on' };
  world.say({ id: sent('fleet.order')[0]?.id, error });
  await ordered;
  expect(desk.report).toMatchObject({ is: 'failed', why: 'the broker does not pass it on' });
});

test('WhatIsDeployedLacksTheUnsavedChangesThatAPersonHasSeen', async () => {
  const { world, desk, sent } = make();
  const deployed = desk.deploy(['r1'], ' 1,100% ', ['robot.aesl']);
  await settled();
  const [order] = sent('fleet.deploy');
  expect(order?.in).toEqual({ robots: ['r1'], steps: '1,100%', without: ['robot.aesl'] });
  const error = { code: 'conflict', what: 'hall.aesl has unsaved changes' };
  world.say({ id: order?.id, error });
  expect(await deployed).toBe(false);
  expect(desk.deployWhy).toBe('hall.aesl has unsaved changes');
});

test('EventsThatComeAgainWithANewConnectionAreListedOnce', async () => {
  const { world, desk, sent } = make();
  const end = desk.follow();
  const say = (items: FleetEvent[]) => {
    world.say({ watch: sent('watch').at(-1)?.in['watch'], items, left_out: 1 });
  };
  say([event(1), event(2)]);
  world.last.events.closed();
  world.pass(60_000);
  world.welcome();
  say([event(2), event(3)]);
  expect(desk.events.map(({ number }) => number)).toEqual([1, 2, 3]);
  expect(desk.leftOut).toBe(2);
  // So many are kept.
  say(Array.from({ length: kFleetEventsKept }, (_, at) => event(at + 4)));
  expect(desk.events).toHaveLength(kFleetEventsKept);
  expect(desk.events[0]?.number).toBe(4);
  end();
  await settled();
});

test('OfAnotherFleetNothingIsLeftOver', () => {
  const { world, desk, sent } = make();
  desk.follow();
  world.say({ watch: sent('watch').at(-1)?.in['watch'], items: [event(1)], left_out: 0 });
  desk.set({ query: 'r1', choice: { chosen: new Set(['r1']), at: 'r1', from: 'r1' } });
  desk.enter('mqtt://broker/lab');
  expect(desk.query).toBe('r1');
  desk.enter('mqtt://broker/hall');
  expect(desk.query).toBe('');
  expect(desk.choice.chosen.size).toBe(0);
  expect(desk.events).toEqual([]);
});
