import { expect, test, vi } from 'vitest';
import { createWindowStore } from '../../core/window_state';
import type { Studio } from '../../core/studio';
import { refuse, whyNot } from './why_not';

const studio = () =>
  ({
    window: createWindowStore(),
    registry: { isEnabled: () => false },
    topics: { get: () => ({ project: { name: 'P' } }) },
    drives: true,
    past: { at: null },
    connection: { link: { state: 'open' } },
  }) as unknown as Studio;

test.each([
  ['Alt+Shift+U', true],
  ['F12', true],
  ['Alt+Enter', true],
  ['Ctrl+F9', true],
  ['Ctrl+F', false],
  ['Delete', false],
])('TheKeySaysWhyItDoesNothing %s %s', (key, says) => {
  const own = studio();
  const command = { id: 'node.load', title: 'Upload', group: '', run: vi.fn() };
  expect(refuse(own, command, key)).toBe(says);
  expect(own.window.getState().toasts.map((one) => one.text)).toEqual(
    says ? ['Upload: No node is connected.'] : [],
  );
});

test.each([
  ['W', true],
  ['Shift+N', true],
  ['Delete', true],
  ['Escape', false],
  ['Enter', false],
  ['ArrowLeft', false],
  ['Ctrl+D', false],
])('AKeyOfAPlaceSaysSoThere %s %s', (key, says) => {
  const own = studio();
  const why = { id: 'world.why', title: 'Why?', group: '', within: 'world', run: vi.fn() };
  expect(refuse(own, why, key)).toBe(says);
  expect(own.window.getState().toasts.map((one) => one.text)).toEqual(
    says ? ['Why? Select a robot of the run first.'] : [],
  );
});

const command = (id: string) => ({ id, title: id, group: '', run: vi.fn() });

test('TheReasonIsTheOneThatAPersonCanRemove', () => {
  const looking = Object.assign(studio(), { drives: false });
  expect(whyNot(looking, command('run.start'))).toBe('View only: request control first.');
  expect(whyNot(looking, command('edit.definition'))).toBe('Open a script first.');
  const away = Object.assign(studio(), {
    drives: false,
    connection: { link: { state: 'lost', since: 0 } },
  });
  for (const id of ['run.start', 'driver.ask'])
    expect(whyNot(away, command(id))).toBe('The studio does not answer. Wait until it is back.');
  const past = Object.assign(studio(), { past: { at: 1 } });
  const looksBack = 'You are looking back: press Esc to return to now.';
  for (const id of ['node.loadAll', 'plan.pause', 'tests.run', 'draw.into'])
    expect(whyNot(past, command(id))).toBe(looksBack);
  expect(whyNot(past, command('run.end'))).toBe('The run answers. Stop ends it.');
});

// Of a keyboard with AltGr they are characters: Ctrl+Alt+E is the sign of the euro.
test('NoCommandIsOnAKeyThatAltGrTypes', () => {
  const files = import.meta.glob<string>(['../**/*.{ts,tsx}', '!../**/*.test.ts'], {
    query: '?raw',
    import: 'default',
    eager: true,
  });
  const found = Object.entries(files).filter(([, text]) => /Ctrl\+Alt\+.\b/.test(text));
  expect(Object.keys(files).length).toBeGreaterThan(100);
  expect(found.map(([file]) => file)).toEqual([]);
});
