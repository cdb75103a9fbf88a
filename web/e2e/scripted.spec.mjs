// Tests of behaviour without a plan, as a pupil with a Thymio comes to them: a run of a script is
// kept as a test, the script is changed, the robot bumps, and the test says so.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { makeProject } from './support/robots.mjs';
import { focused, gone, reads, seen, test, until } from './support/studio.mjs';
/** @import { Page, TestContext } from './support/studio.mjs' */

const json = (/** @type {unknown} */ value) => JSON.stringify(value, null, 2);

/** 40 of 500 are 1.3 cm a second: the wall, 20 cm ahead, is 15 s away. At 500 it is one. */
const slow = `# drives ahead
var ticks = 0
timer.period[0] = 500
motor.left.target = 40
motor.right.target = 40
onevent timer0
	ticks = ticks + 1
	emit tick
`;
const room = {
  format: 'vagus-world/1',
  name: 'Room',
  seed: 1,
  size: [1, 1],
  robots: [{ name: 'thymio', type: 'thymio2', at: [0.7, 0.5], angle: 0, script: 'ahead.aesl' }],
};
const project = (/** @type {unknown} */ world) => ({
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(
      t,
      { name: 'Thymio', world: 'room.world.json', target: 'sim', scripts: ['ahead.aesl'] },
      { 'room.world.json': json(world), 'ahead.aesl': slow },
    ),
});
const thymio = project(room);
/** The script is named by the project alone, and Run loads it. */
const bare = project({
  ...room,
  robots: room.robots.map((one) => ({ ...one, script: undefined })),
});

const said = (/** @type {Page} */ page) => page.locator('.tests__said');
/** What was written as room.test.json. */
function keptTest(/** @type {string} */ folder) {
  const path = readdirSync(folder, { recursive: true, encoding: 'utf8' }).find((one) =>
    one.endsWith('room.test.json'),
  );
  assert.ok(path !== undefined);
  return JSON.parse(readFileSync(join(folder, path), 'utf8'));
}
const clock = async (/** @type {Page} */ page) =>
  parseFloat(await page.locator('.clock__time').innerText());

test(
  'a run of a script becomes a test, which fails when the robot bumps',
  thymio,
  async (studio) => {
    const { page, press, type, layout, command, server } = studio;
    await layout('Script');
    await press('F5');
    await until('it has driven for a while', async () => (await clock(page)) > 2);
    await press('Shift+F5');
    await command('Show Timeline');
    await page.getByRole('button', { name: 'Keep the run as a test' }).click();
    await focused(page.getByRole('textbox', { name: /room\.test\.json/ }));
    const kept = keptTest(server.folder);
    assert.equal(kept.plan, undefined);
    assert.equal(kept.world, 'room.world.json');
    assert.deepEqual(kept.expect[0], { always: 'contact == 0', help: 'touches nothing' });
    assert.equal(kept.expect[1].eventually, "event == 'tick'");
    assert.match(kept.expect[2].eventually, /^t > [\d.]+ and abs\(x - 0\.7\d?\) < 0\.1 and abs\(y/);
    assert.deepEqual(kept.expect.at(-1), { ends: 'MaxTime' });
    await press('F5');
    await reads(said(page), /^1 run as expected\./);

    await page.getByRole('treeitem', { name: /^ahead\.aesl/ }).focus();
    await press('Enter');
    await seen(page.locator('.cm-line').filter({ hasText: 'motor.left.target' }));
    for (const side of ['left', 'right']) {
      await page
        .locator('.cm-line')
        .filter({ hasText: `motor.${side}.target` })
        .click();
      await press('End', 'Backspace', 'Backspace');
      await type('500');
    }
    await command('Run all tests of the project');
    await reads(said(page), '1 of 1 run not as expected.');
    const failed = page
      .getByRole('list', { name: 'Tests, and what was not as expected' })
      .locator('[data-row]')
      .nth(1);
    await reads(failed, /seed 1[^]*always "contact == 0"[^]*contact = 0\.0\d*, x = 0\.\d+/);
    const at = Number(
      /at ([\d.]+) s|([\d.]+) s/.exec(await failed.innerText())?.[0].match(/[\d.]+/),
    );
    await page.getByRole('button', { name: 'Open the recording' }).first().click();
    const bar = page.getByRole('region', { name: 'Looking back' });
    await seen(bar);
    const shown = Number(/shows ([\d.]+) s/.exec(await bar.innerText())?.[1]);
    assert.ok(Math.abs(shown - at) < 0.02, `${shown} s is shown, it failed at ${at} s`);
    await press('Escape');
    await gone(bar);
    await page.getByRole('button', { name: 'Run by hand' }).first().click();
    await until('it runs from its beginning', async () => {
      const t = await clock(page);
      return t > 0.2 && t < 4;
    });
    await press('Shift+F5');
  },
);

test('the run of a script is kept by a command, once one has begun', bare, async (studio) => {
  const { page, press, command, server } = studio;
  await command('Show Timeline');
  // Nothing has run: there is nothing to keep, and the button says so.
  const keep = page.getByRole('button', { name: /^Keep the run as a test/ });
  assert.equal(await keep.isDisabled(), true);
  await press('F5');
  await until('it has driven for a while', async () => (await clock(page)) > 1);
  await press('Shift+F5');
  await command('Keep the run as a test');
  await focused(page.getByRole('textbox', { name: /room\.test\.json/ }));
  assert.deepEqual(keptTest(server.folder).scripts, ['ahead.aesl']);
  await press('F5');
  await reads(said(page), /^1 run as expected\./);
});
