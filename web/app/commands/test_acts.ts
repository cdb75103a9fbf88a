// What is done with tests of behaviour, from the panel, the bar of a test, the tree and by keys.

import { isTest } from '../../core/paths';
import type { Studio } from '../../core/studio';
import { testOptionsOf } from '../../core/tests';
import { revealDoc, revealPanel } from '../../core/window_state';
import type { Path, TestFailure } from '../../protocol/messages';
import { lookIntoRecording } from './look_into_recording';

/** The test that is looked at: the row of the tree that has the keyboard, else the document. */
export function testMeant(studio: Studio): Path | null {
  const row = document.activeElement?.closest<HTMLElement>('.tree [data-path]');
  const path = row?.dataset['path'] ?? studio.window.getState().doc;
  return path !== null && isTest(path) ? path : null;
}

/** Runs these, or all of the project, as they are on the screen; what comes of them is shown. */
export async function runTests(studio: Studio, tests: readonly Path[] | null): Promise<void> {
  await studio.documents.flushAll();
  const { scripts } = testOptionsOf(studio);
  await studio.send('tests.run', tests === null ? { scripts } : { tests: [...tests], scripts });
  revealPanel(studio.window, 'tests', false);
}

export async function stopTests(studio: Studio): Promise<void> {
  await studio.send('tests.stop', {});
}

/** The line of the test; the keyboard stays in the list. */
export function showExpectation(studio: Studio, path: Path, { at }: TestFailure): void {
  revealDoc(studio.window, path, at ?? null, false);
}

/** Runs the recorded run again, and shows the instant at which it failed. */
export async function openFailure(studio: Studio, failure: TestFailure): Promise<void> {
  if (failure.recording === undefined) return;
  await lookIntoRecording(studio, failure.recording, failure.t, () => {
    // The list stays in sight, with the keyboard in it: the drawing shows what happened.
    const plan = studio.topics.get('plan', {})?.doc;
    if (plan !== undefined) revealDoc(studio.window, plan, null, false);
  });
}

/** The same run from its beginning, live: with its seed and its place. */
export async function runByHand(studio: Studio, failure: TestFailure): Promise<void> {
  if (failure.recording === undefined) return;
  await studio.send('recording.open', { path: failure.recording, live: true });
}
