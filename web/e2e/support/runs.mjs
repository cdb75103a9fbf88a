// Runs of the simulator in the studio.
import assert from 'node:assert/strict';
import { readdirSync } from 'node:fs';
import { join } from 'node:path';
import { seen } from './studio.mjs';
/** @import { Studio } from './studio.mjs' */

/** Runs as fast as it goes, until the plan comes to that actor. */
export async function runTo(
  /** @type {Studio} */ { page, press, layout },
  /** @type {string} */ actor,
) {
  await layout('Debug');
  await page.getByRole('group', { name: new RegExp(`^${actor}, actor`) }).focus();
  await press('Space', 'F9');
  await page.getByRole('button', { name: /Speed of the clock/ }).click();
  await page.getByRole('menuitem', { name: /As fast as/i }).click();
  await press('F5');
  await seen(page.getByText(`Paused by the breakpoint ${actor}`));
}

/** The recording of the run that is shown. */
export function lastRecording(/** @type {string} */ folder) {
  const number = (/** @type {string} */ one) => Number(/run-(\d+)\.mcap$/.exec(one)?.[1] ?? 0);
  const [last] = readdirSync(folder, { recursive: true, encoding: 'utf8' })
    .filter((one) => number(one) > 0)
    .sort((one, other) => number(other) - number(one));
  assert.ok(last, 'a run was recorded');
  return join(folder, last);
}
