import { afterEach, expect, test, vi } from 'vitest';
import { createWindowStore } from '../../core/window_state';
import type { Studio } from '../../core/studio';
import { copyText } from './clipboard';

afterEach(() => vi.unstubAllGlobals());

const said = (studio: Studio) => studio.window.getState().toasts.map((one) => one.text);
const studio = () => ({ window: createWindowStore() }) as unknown as Studio;

test('CopiesAndSaysSo', async () => {
  const writeText = vi.fn();
  vi.stubGlobal('navigator', { clipboard: { writeText } });
  const own = studio();
  await copyText(own, 'a/b.txt', 'copied');
  expect(writeText).toHaveBeenCalledWith('a/b.txt');
  expect(said(own)).toEqual(['copied']);
});

test.each([
  [true, ['copied']],
  [false, []],
])('CopiesWithoutHttpsWhereTheBrowserDoes %s', async (does, toasts) => {
  const field = { value: '', select: vi.fn(), remove: vi.fn() };
  vi.stubGlobal('HTMLElement', class {});
  vi.stubGlobal('navigator', {});
  vi.stubGlobal('document', {
    activeElement: null,
    body: { append: vi.fn() },
    createElement: () => field,
    execCommand: () => does,
  });
  const own = studio();
  const copied = copyText(own, 'a/b.txt', 'copied');
  if (does) await copied;
  else await expect(copied).rejects.toThrow();
  expect(field.value).toBe('a/b.txt');
  expect(field.remove).toHaveBeenCalled();
  expect(said(own)).toEqual(toasts);
});
