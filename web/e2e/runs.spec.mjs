// Two recorded runs side by side: the first difference of each lane, and both at that instant.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { copyFileSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { look } from './support/axe.mjs';
import { lastRecording, runTo } from './support/runs.mjs';
import { vagusProgram } from './support/server.mjs';
import { reads, seen, test, until } from './support/studio.mjs';
/** @import { Page, Studio } from './support/studio.mjs' */

const wall = { words: ['--example', 'follow-wall'] };

const bar = (/** @type {Page} */ page) => page.getByRole('region', { name: 'Looking back' });
const lanes = (/** @type {Page} */ page) =>
  page.getByRole('list', { name: /^First difference of each lane/ }).getByRole('button');
const cursor = (/** @type {Page} */ page) =>
  page.getByRole('slider', { name: 'Instant that is shown of both' });
const form = (/** @type {Page} */ page) =>
  page.getByRole('form', { name: 'Which runs are compared' });

/** A run of the same plan and world with another variable, as a file of the project. */
async function recordOther(/** @type {string} */ folder) {
  const project = await until('the project is a folder', () => {
    const all = readdirSync(folder, { recursive: true, encoding: 'utf8' });
    const plan = all.find((one) => one.endsWith('WallFollow.plan.json'));
    return plan === undefined ? undefined : dirname(join(folder, plan));
  });
  const other = join(project, 'other.mcap');
  const words = ['plan', 'run', 'WallFollow.plan.json', '--world', 'hall.world.json'];
  const more = ['--set', 'walldist=45', '--clock', 'virtual', '--max-time', '12', '--quiet'];
  spawnSync(vagusProgram, [...words, ...more, '--record', other], { cwd: project });
  return other;
}

/** What the command line tells: the instant of each lane that differs. */
function compared(
  /** @type {string} */ folder,
  /** @type {string} */ other,
  /** @type {string[]} */ ...align
) {
  const words = ['compare', lastRecording(folder), other, '--json'];
  const { stdout } = spawnSync(vagusProgram, [...words, ...align], { encoding: 'utf8' });
  const { lanes } = /** @type {{ lanes: { difference: { a_t: number } | null }[] }} */ (
    JSON.parse(stdout)
  );
  return lanes.flatMap(({ difference }) => (difference ? [difference.a_t.toFixed(3)] : []));
}

async function listed(/** @type {Page} */ page) {
  const rows = await lanes(page).all();
  return Promise.all(
    rows.map(async (row) => {
      // In words, not as channels of a recording and JSON.
      assert.doesNotMatch(await row.innerText(), /\/\w+\/|[{}]/);
      return parseFloat(await row.locator('time').innerText()).toFixed(3);
    }),
  );
}

/** Chooses a recording, by the keyboard. */
async function choose(
  /** @type {Studio} */ { page, press },
  /** @type {string} */ side,
  /** @type {string} */ file,
) {
  const list = form(page).getByRole('combobox', { name: side, exact: true });
  await until('the recording is listed', async () => (await list.innerText()).includes(file));
  await list.focus();
  for (let at = 0; !(await list.inputValue()).endsWith(file); ++at) {
    assert.ok(at < 10, `${file} can be chosen`);
    await press('ArrowDown');
  }
}

test('a run beside a recording of another one', wall, async (studio) => {
  const { page, press, type, server } = studio;
  const other = await recordOther(server.folder);
  await runTo(studio, 'parallelToWall');
  await page.getByRole('tab', { name: 'Timeline' }).click();
  await page.getByRole('button', { name: 'Open a run before this one' }).click();
  await page.getByRole('menuitem', { name: 'Compare with…' }).click();
  await seen(form(page));
  // By keys alone from here: the other run, and compare.
  await choose(studio, 'B', 'other.mcap');
  await press('Tab', 'Tab', 'Enter');
  await seen(lanes(page));
  const expected = compared(server.folder, other);
  assert.ok(expected.length > 3, expected.join('; '));
  assert.deepEqual(await listed(page), expected);
  await look(studio, 'runs');
  // To a difference by the keyboard: both are shown there, and the run of the window, too.
  await lanes(page).first().focus();
  const later = expected.findIndex((one) => parseFloat(one) > 1);
  assert.ok(later > 0);
  for (let at = 0; at < later; ++at) await press('ArrowDown');
  await press('Enter');
  const t = expected[later] ?? '';
  await reads(bar(page), new RegExp(`Everything shows ${t} s`));
  await until(
    'the slider is there',
    async () => (await cursor(page).getAttribute('aria-valuetext')) === `${t} seconds`,
  );
  const robots = page.locator('.runs__robot');
  assert.equal(await robots.count(), 2);
  // The slider goes through both.
  await cursor(page).focus();
  await press('ArrowRight');
  await until(
    'a later instant is shown',
    async () =>
      parseFloat((await cursor(page).getAttribute('aria-valuetext')) ?? '') > parseFloat(t),
  );
  // Aligned at an actor; what is not there is told.
  await form(page).getByRole('combobox', { name: 'Aligned at' }).focus();
  await press('ArrowDown', 'Tab');
  await type('findwallangle');
  await press('Enter');
  await reads(
    page.getByRole('alert'),
    /\.mcap began no actor "findwallangle"; did you mean findWallAngle\?/,
  );
  await press('Control+a');
  await type('findWallAngle');
  await press('Enter');
  await seen(lanes(page));
  assert.deepEqual(
    await listed(page),
    compared(server.folder, other, '--align', 'actor', 'findWallAngle'),
  );
  await reads(lanes(page).first(), /s of A, .* s of B/);
  // The other one in the whole window; the run that was shown is a recording by then.
  await page.getByRole('button', { name: 'Show B here' }).click();
  await seen(bar(page));
  const a = form(page).getByRole('combobox', { name: 'A', exact: true });
  await until('A is named', async () => /run-\d+\.mcap$/.test(await a.inputValue()));
  await seen(lanes(page));
});

test('from the tree, the same twice has no difference', wall, async (studio) => {
  const { page, server, layout } = studio;
  await layout('Script');
  const other = await recordOther(server.folder);
  copyFileSync(other, join(dirname(other), 'again.mcap'));
  const row = page.getByRole('treeitem', { name: /other\.mcap/ });
  await row.click({ button: 'right' });
  await page.getByRole('menuitem', { name: 'Compare with…' }).click();
  await seen(form(page));
  await choose(studio, 'A', 'again.mcap');
  await page.getByRole('button', { name: 'Compare', exact: true }).click();
  await seen(page.getByText('No difference: both runs are the same.'));
  assert.equal(await page.locator('.runs__robot').count(), 2);
});
