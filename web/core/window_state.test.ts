import { expect, test } from 'vitest';
import {
  createWindowStore,
  kToastsMax,
  revealDoc,
  revealPanel,
  toast,
  update,
  updateEvents,
} from './window_state';

test('an update leaves what was there before as it was, and tells of changes only', () => {
  const store = createWindowStore();
  const before = store.getState();
  let told = 0;
  store.subscribe(() => told++);
  update(store, (draft) => void (draft.layout = 'Script'));
  expect(told).toBe(0);
  expect(store.getState()).toBe(before);
  update(store, (draft) => void (draft.layout = 'Debug'));
  expect(told).toBe(1);
  expect(before.layout).toBe('Script');
  expect(store.getState().listing).toBe(before.listing);
});

test('how events are listed changes by parts; no other window shares it', () => {
  const store = createWindowStore();
  const { filter } = store.getState().events;
  updateEvents(store, { filter: { ...filter, find: 'beat' } });
  expect(store.getState().events).toMatchObject({ paused: false, filter: { find: 'beat' } });
  expect(createWindowStore().getState().events.filter.find).toBe('');
});

test('the oldest toast goes when there are too many; one that says the same is not added', () => {
  const store = createWindowStore();
  for (let number = 0; number <= kToastsMax; number++) toast(store, 'note', `number ${number}`);
  toast(store, 'note', 'number 3');
  const texts = store.getState().toasts.map(({ text }) => text);
  expect(texts).toEqual(['number 1', 'number 2', 'number 4', 'number 5', 'number 3']);
});

test('a panel that shows itself does not make a place forgotten that is not yet shown', () => {
  const store = createWindowStore();
  const at = { line: 7, column: 1 };
  revealDoc(store, 'a.aesl', at);
  revealPanel(store, 'problems', false);
  expect(store.getState().reveal).toMatchObject({ what: 'doc', doc: 'a.aesl', at });
  // One that is asked for by a person comes.
  revealPanel(store, 'problems');
  expect(store.getState().reveal).toMatchObject({ what: 'panel', panel: 'problems' });
});
