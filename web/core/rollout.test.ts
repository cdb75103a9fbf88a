import { expect, test } from 'vitest';
import type { RolloutRobot } from '../protocol/messages';
import { mayRollBack, rowsOf, wellIn, type Rollout } from './rollout';

const robot = (at: number, is: RolloutRobot['is'], has = false): RolloutRobot => ({
  at,
  is,
  why: '',
  has,
});
const rollout = (robots: Rollout['robots'], more: Partial<Rollout> = {}): Rollout => ({
  state: 'failed',
  target: 'mqtt://broker/lab',
  version: 'Rover',
  back: false,
  by: 'page',
  why: '',
  begun_wall: 0,
  served: true,
  robots,
  ...more,
});

test('WhatWentWrongComesFirst', () => {
  const rows = rowsOf(
    rollout({
      r1: robot(0, 'well', true),
      r2: robot(1, 'failed'),
      r3: robot(2, 'started', true),
      r5: robot(4, 'later'),
      r4: robot(3, 'later'),
    }),
  );
  expect(rows.map(({ name }) => name)).toEqual(['r2', 'r3', 'r4', 'r5', 'r1']);
  expect(wellIn(rows)).toBe(1);
});

test('OnlyWhatSomebodyHasIsTakenBackAndNotWhileItRuns', () => {
  const robots = { r1: robot(0, 'well', true) };
  expect(mayRollBack(rollout(robots))).toBe(true);
  expect(mayRollBack(rollout(robots, { state: 'running' }))).toBe(false);
  expect(mayRollBack(rollout(robots, { back: true }))).toBe(false);
  expect(mayRollBack(rollout({ r1: robot(0, 'failed') }))).toBe(false);
});
