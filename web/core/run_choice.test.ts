import { describe, expect, it } from 'vitest';
import type { Topics } from '../protocol/messages';
import {
  endedPlan,
  isReady,
  missingFor,
  planInRun,
  planMeant,
  runOrder,
  whatRuns,
} from './run_choice';

const exists = (doc: string) => doc !== 'gone.plan.json';
const meant = (doc: string | null, kept: unknown, project?: string) =>
  planMeant({ doc, kept: kept as never, project, exists });
const plan = (state: string, doc?: string) =>
  ({ state, doc, t: 0, levels: [], story: [] }) as unknown as Topics['plan']['is'];
const robot = (kind: string, names: string[], state = 'connected') =>
  ({
    kind,
    state,
    nodes: names.map((name) => ({ name, doc: `a.aesl#${name}`, state: 'running' })),
  }) as unknown as Topics['robot']['is'];

describe('the plan that F5 is for', () => {
  it('is the one that is looked at, whatever vagus.json names', () => {
    expect(meant('b.plan.json', { 'run.plan': 'c.plan.json' }, 'a.plan.json')).toBe('b.plan.json');
  });
  it('is the last one that ran where a script is looked at', () => {
    expect(meant('a.aesl#x', { 'run.plan': 'c.plan.json' }, 'a.plan.json')).toBe('c.plan.json');
  });
  it('is that of vagus.json where none has run, or its file has gone', () => {
    expect(meant(null, {}, 'a.plan.json')).toBe('a.plan.json');
    expect(meant(null, { 'run.plan': 'gone.plan.json' }, 'a.plan.json')).toBe('a.plan.json');
    expect(meant(null, { 'run.plan': 7 })).toBeUndefined();
    expect(meant(null, undefined)).toBeUndefined();
  });
});

describe('what F5 sends', () => {
  it('names a plan that vagus.json does not', () => {
    const order = { command: 'plan.start', doc: 'b.plan.json' };
    expect(runOrder('b.plan.json', plan('none'), false, undefined)).toEqual(order);
    expect(runOrder('b.plan.json', plan('ended', 'a.plan.json'), false, 'a.plan.json')).toEqual(
      order,
    );
    expect(runOrder('b.plan.json', plan('running', 'a.plan.json'), false, 'a.plan.json')).toEqual(
      order,
    );
  });
  it('lets go on what is paused, and leaves a running plan alone', () => {
    const on = { command: 'run.start' };
    expect(runOrder('b.plan.json', plan('paused', 'a.plan.json'), true, 'a.plan.json')).toEqual(on);
    expect(runOrder('a.plan.json', plan('running', 'a.plan.json'), false, undefined)).toEqual(on);
    expect(runOrder(undefined, plan('none'), false, undefined)).toEqual(on);
    expect(runOrder('a.plan.json', undefined, false, 'a.plan.json')).toEqual(on);
  });
  it('is for the plan that runs where its active sub-plan is looked at', () => {
    const levels = [{ doc: 'a.plan.json' }, { doc: 'sub.plan.json' }];
    const runs = { ...plan('running', 'a.plan.json'), levels } as never;
    expect(planInRun('sub.plan.json', runs)).toBe('a.plan.json');
    expect(planInRun('b.plan.json', runs)).toBe('b.plan.json');
    expect(planInRun('sub.plan.json', { ...plan('ended', 'a.plan.json'), levels } as never)).toBe(
      'sub.plan.json',
    );
  });
  it('starts that of vagus.json in place of another that runs', () => {
    expect(runOrder('a.plan.json', plan('running', 'b.plan.json'), false, 'a.plan.json')).toEqual({
      command: 'plan.start',
      doc: 'a.plan.json',
    });
  });
});

it('what runs is named by its plan, else by its nodes', () => {
  expect(whatRuns(robot('simulator', ['drive']), plan('running', 'x/Wall.plan.json'))).toBe('Wall');
  expect(whatRuns(robot('bus', ['a', 'b']), plan('ended', 'Wall.plan.json'))).toBe('a, b');
  expect(whatRuns(robot('simulator', []), plan('none'))).toBe('');
  const [first, ...others] = robot('bus', ['a', 'b']).nodes;
  const paused = { nodes: [{ ...first, state: 'paused' }, ...others] } as never;
  expect(whatRuns(paused, plan('none'))).toBe('b');
});

it('a plan that has ended is told with its result until another run begins', () => {
  const ended = { ...plan('ended', 'x/Wall.plan.json'), result: 'OK' } as never;
  expect(endedPlan(ended)).toEqual({ name: 'Wall', result: 'OK' });
  expect(endedPlan(plan('running', 'Wall.plan.json'))).toBeNull();
  expect(endedPlan(plan('none'))).toBeNull();
});

it('nodes of a simulator wait until its time passes for the first time', () => {
  const simulator = { kind: 'simulator' } as const;
  expect(isReady(simulator, { state: 'none', t: 0 })).toBe(true);
  expect(isReady(simulator, { state: 'none', t: 2.5 })).toBe(false);
  expect(isReady(simulator, { state: 'running', t: 0 })).toBe(false);
  expect(isReady({ kind: 'bus' }, { state: 'none', t: 0 })).toBe(false);
});

it('what a run lacks is told by the target, the world and the nodes', () => {
  const world = { world: 'w.world.json' };
  expect(missingFor(robot('none', [], 'none'), {})).toBe('target');
  expect(missingFor(robot('none', [], 'none'), { bare: true })).toBe('project');
  expect(missingFor(robot('none', [], 'none'), { ...world, bare: true })).toBeNull();
  expect(missingFor(robot('none', [], 'none'), world)).toBeNull();
  expect(missingFor(robot('bus', []), { bare: true })).toBe('node');
  expect(missingFor(robot('simulator', []), world)).toBe('robot');
  expect(missingFor(robot('bus', [], 'connecting'), {})).toBeNull();
  expect(missingFor(robot('bus', ['a']), {})).toBeNull();
});
