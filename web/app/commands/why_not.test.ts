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
  ['Ctrl+Alt+U', true],
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
