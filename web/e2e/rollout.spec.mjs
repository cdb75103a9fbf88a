// Another version for robots of a fleet, from its page, over a real broker: real robots fetch it.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { look } from './support/axe.mjs';
import { makeAlarm, startMember, startOwnBroker } from './support/fleet.mjs';
import { startServer } from './support/server.mjs';
import { openWindow, reads, seen, test } from './support/studio.mjs';
/** @import { Page } from './support/studio.mjs' */
/** @import { Test } from './support/server.mjs' */

/**
 * Robots r1 and r2, and a studio with another version of their project.
 * @param {Parameters<typeof makeAlarm>[1]} version
 */
const twoRobots = (version) => ({
  async prepare(/** @type {Test} */ t) {
    const broker = await startOwnBroker(t, ['r1', 'r2']);
    for (const name of ['r1', 'r2']) await startMember(t, broker.target, name, broker.login(name));
    const { place } = makeAlarm(t, version);
    return { place, words: [place, '--fleet', broker.target, ...broker.login('operator')] };
  },
});

/** @param {Page} page */
const handsOn = (page) => ({
  async open() {
    await page.getByRole('radio', { name: 'Fleet lab' }).click();
    await seen(page.getByRole('option', { name: /^r1 running/ }));
    await seen(page.getByRole('option', { name: /^r2 running/ }));
  },
  panel: page.getByRole('region', { name: 'Roll-out' }),
  summary: page.locator('.frollout__head strong'),
  row: (/** @type {string} */ robot) => page.locator(`[data-rollout="${robot}"] td`),
});

test(
  'a version for all robots in steps, seen by a second page, and taken back',
  twoRobots({ script: 'var edition = 2\n' }),
  async (studio, t) => {
    const { page, press, button, server } = studio;
    const { open, panel, summary, row } = handsOn(page);
    await open();
    await button('Deploy…').focus();
    await press('Enter');
    await seen(page.getByText('Alarm, as it is saved, for all 2 robots.'));
    await press('Enter'); // from the field of the steps
    await reads(row('r1'), 'well');
    await reads(row('r2'), 'well');
    await reads(summary, 'Deploy Alarm: 2 of 2 robots well');
    await look(studio, 'a roll-out');
    const other = await openWindow(t, server, {});
    await handsOn(other.page).open();
    await reads(handsOn(other.page).summary, 'Deploy Alarm: 2 of 2 robots well');
    await page.reload();
    await open();
    await seen(panel);
    await page.getByRole('button', { name: 'Roll back' }).focus();
    await press('Enter');
    await reads(summary, 'Roll back Alarm: 2 of 2 robots well');
    await page.getByRole('button', { name: 'Dismiss' }).click();
    await panel.waitFor({ state: 'detached' });
  },
);

test(
  'unsaved changes are left out or saved, as a person decides',
  twoRobots({ script: 'var edition = 2\n' }),
  async (studio) => {
    const { page, press, button, place, type } = studio;
    const { open, row, summary } = handsOn(page);
    const script = () => readFileSync(join(place, 'robot.aesl'), 'utf8');
    await studio.tab(/^thymio-II/).click();
    await studio.editor('thymio-II').click();
    await press('Control+Home');
    await type('# typed later\n');
    await open();
    await button('Deploy…').click();
    await seen(page.getByText('Unsaved changes in robot.aesl.'));
    await look(studio, 'a roll-out with unsaved changes');
    await press('Enter'); // in the field of the steps: nothing is decided yet
    await seen(page.getByText('Save all, or deploy without these changes.'));
    await button('Deploy without these changes').click();
    await reads(summary, 'Deploy Alarm: 2 of 2 robots well');
    assert.doesNotMatch(script(), /typed later/);
    await button('Deploy…').click();
    await button('Save all').click();
    await page.getByText('Unsaved changes in').waitFor({ state: 'detached' });
    assert.match(script(), /typed later/);
    await press('Enter');
    await reads(row('r1'), 'well');
    await reads(row('r2'), 'well');
  },
);

test(
  'a bad version stops at the first robot, which says why',
  twoRobots({ script: 'onevent nobody.knows.this\n\tx = 1\n' }),
  async ({ page, press, button }) => {
    const { open, row, panel } = handsOn(page);
    await open();
    await button('Deploy…').click();
    await press('Enter');
    await reads(row('r1'), /^failed: refused: it has mistakes; nothing was changed; robot\.aesl/);
    await reads(row('r2'), 'as it was');
    await seen(panel.getByText('ended: a robot is not well'));
    await seen(page.getByRole('option', { name: /^r1 running/ }));
  },
);

test(
  'a robot that is not well yet is waited for; stopped, and left by a server that was killed',
  twoRobots({
    script: 'var edition = 2\n',
    more: { healthy: { condition: "node('thymio-II', 'edition') > 2", for: 1 } },
  }),
  async (studio, t) => {
    const { page, press, button, server, words } = studio;
    const { open, row, panel } = handsOn(page);
    await open();
    const begin = async () => {
      await button('Deploy…').click();
      await press('Enter');
      await seen(panel.getByText(/^under way/));
      await reads(row('r1'), /^started: its condition .* is not true: .* = 2$/);
    };
    await begin();
    await page.getByRole('button', { name: 'Stop roll-out' }).click();
    await seen(panel.getByText(/^stopped by .*; robots that have the version keep it/));
    await reads(row('r2'), 'as it was');
    await begin();
    server.program.child.kill('SIGKILL');
    const again = await openWindow(t, await startServer(t, words, server.folder), {});
    await handsOn(again.page).open();
    await seen(
      handsOn(again.page).panel.getByText(/^the studio that gave it ended before it was over/),
    );
    await seen(again.page.getByRole('button', { name: 'Roll back' }));
    await reads(handsOn(again.page).row('r1'), /^started: its condition .* is not true: .* = 2$/);
    await again.page.getByRole('option', { name: /^r1 running/ }).click();
    await again.page.getByRole('button', { name: 'Set a variable' }).click();
    await again.page.getByLabel('Variable', { exact: true }).fill('thymio-II.edition');
    await again.page.getByLabel('Value', { exact: true }).fill('3');
    await again.page.keyboard.press('Enter');
    await reads(handsOn(again.page).row('r1'), 'well');
    studio.complaints.length = 0; // the window of the server that was killed
  },
);
