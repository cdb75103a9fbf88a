import { expect, test } from 'vitest';
import type { Node, Topics } from '../protocol/messages';
import { runStateOf } from './run_state';

type Robot = Topics['robot']['is'];
const node = (state: Node['state'], doc?: string): Node => ({
  id: 1,
  name: 'left',
  robot: '',
  state,
  protocol: 9,
  described: true,
  program: 'current',
  ...(doc ? { doc } : {}),
});
const robot = (kind: Robot['kind'], ...nodes: Node[]): Robot => ({
  target: '',
  name: '',
  kind,
  state: 'connected',
  nodes,
  twins: [],
  lost: 0,
  events_a_second: 0,
});
const clock = (state: Topics['clock']['is']['state']) => ({
  t: 0,
  wall: 0,
  state,
  speed: 1,
  real: 1,
});

test('of a simulator the clock alone says whether it runs', () => {
  const runs = robot('simulator', node('running', 'a.aesl#1'));
  expect(runStateOf(runs, clock('none'), undefined)).toBe('none');
  expect(runStateOf(runs, clock('paused'), undefined)).toBe('held');
  const paused = robot('simulator', node('paused', 'a.aesl#1'));
  expect(runStateOf(paused, clock('running'), undefined)).toBe('running');
  expect(runStateOf(paused, clock('ended'), undefined)).toBe('none');
});

test('on a bus nodes with a script of the project say it', () => {
  expect(runStateOf(robot('bus', node('running')), clock('none'), undefined)).toBe('none');
  const runs = node('running', 'a.aesl#1');
  expect(runStateOf(robot('bus', runs), clock('none'), undefined)).toBe('running');
  const one = robot('bus', runs, node('paused', 'a.aesl#2'));
  expect(runStateOf(one, clock('none'), undefined)).toBe('held');
  expect(runStateOf(robot('bus', node('stopped', 'a.aesl#1')), clock('none'), undefined)).toBe(
    'none',
  );
});

test('nothing is known yet', () => {
  expect(runStateOf(undefined, undefined, undefined)).toBe('none');
});
