import { expect, test } from 'vitest';
import { Connection } from './connection';
import { TestWorld } from './test_world';
import { TopicCache } from './topics';

test('WhatIsForgottenIsUnknownUntilTheServerSaysItAnew', () => {
  const world = new TestWorld();
  const connection = new Connection(world, { token: 'secret', client: 'me', now: () => 0 });
  connection.start();
  world.welcome();
  const topics = new TopicCache(connection, (ms, act) => world.later(ms, act));
  let told = 0;
  topics.subscribe('files', {}, () => void told++);
  topics.subscribe('start', {}, () => {});
  const watches = () => world.last.sent.filter((one) => one.do === 'watch');
  const say = (watch: unknown, whole: unknown) => world.say({ watch, whole });
  say(watches()[0]?.in['watch'], { files: [], more: false });
  say(watches()[1]?.in['watch'], { examples: [], recent: [] });
  expect(topics.get('files', {})).toEqual({ files: [], more: false });

  topics.forget(['start']);
  expect(told).toBe(2);
  expect(topics.get('files', {})).toBeUndefined();
  expect(topics.get('start', {})).toBeDefined();
  // What was on its way for the old subscription says nothing of the new one.
  say(watches()[0]?.in['watch'], { files: [], more: true });
  expect(topics.get('files', {})).toBeUndefined();
  expect(watches()).toHaveLength(3);
  say(watches()[2]?.in['watch'], { files: [], more: false });
  expect(topics.get('files', {})).toEqual({ files: [], more: false });
});
