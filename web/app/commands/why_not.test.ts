import { expect, test, vi } from 'vitest';
import { createWindowStore } from '../../core/window_state';
import type { Studio } from '../../core/studio';
import { refuse } from './why_not';

const studio = () =>
  ({
    window: createWindowStore(),
    registry: { isEnabled: () => false },
    topics: { get: () => ({ project: { name: 'P' } }) },
    drives: true,
    past: { at: null },
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
