// Two recorded runs side by side: the first difference of each lane, and both at that instant.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { readdirSync } from 'node:fs';
import { join } from 'node:path';
import { look } from './support/axe.mjs';
import { runTo } from './support/runs.mjs';
import { root, vagusProgram } from './support/server.mjs';
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

/** A run of the same plan and world with another variable, beside the files of the project. */
function recordOther(/** @type {string} */ folder) {
  const follow = join(root, 'examples/follow-wall');
  const words = ['plan', 'run', 'WallFollow.plan.json', '--world', 'hall.world.json'];
  const more = ['--set', 'walldist=45', '--clock', 'virtual', '--max-time', '12', '--quiet'];
  const other = join(folder, 'other.mcap');
  spawnSync(vagusProgram, [...words, ...more, '--record', other], { cwd: follow });
  return other;
}

/** What the command line tells: name and instant in both of each lane that differs. */
function compared(/** @type {string} */ folder, /** @type {string[]} */ ...align) {
  const mine = readdirSync(folder, { recursive: true, encoding: 'utf8' }).find((one) =>
    one.endsWith('run-1.mcap'),
  );
  assert.ok(mine, 'the run was recorded');
  const words = ['compare', join(folder, mine), join(folder, 'other.mcap'), '--json'];
  const { stdout } = spawnSync(vagusProgram, [...words, ...align], { encoding: 'utf8' });
  const { lanes } =
    /** @type {{ lanes: { lane: string, difference: { a_t: number } | null }[] }} */ (
      JSON.parse(stdout)
    );
  return lanes.flatMap(({ lane, difference }) =>
    difference ? [`${lane} ${difference.a_t.toFixed(3)}`] : [],
  );
}

async function listed(/** @type {Page} */ page) {
  const rows = await lanes(page).all();
  return Promise.all(
    rows.map(async (row) => {
      const name = await row.locator('.runs__name').innerText();
      return `${name.replace(/, .*/, '')} ${parseFloat(await row.locator('time').innerText()).toFixed(3)}`;
    }),
  );
}

/** Chooses in the list of recordings that has the keyboard. */
async function choose(/** @type {Studio} */ { page, press }, /** @type {string} */ value) {
  const list = form(page).getByRole('combobox', { name: 'B', exact: true });
  await list.focus();
  for (let at = 0; (await list.inputValue()) !== value; ++at) {
    assert.ok(at < 10, `${value} can be chosen`);
    await press('ArrowDown');
  }
}

test('a run beside a recording of another one', wall, async (studio) => {
  const { page, press, type, server } = studio;
  recordOther(server.folder);
  await runTo(studio, 'parallelToWall');
  await page.getByRole('tab', { name: 'Timeline' }).click();
  await page.getByRole('button', { name: 'Open a run before this one' }).click();
  await page.getByRole('menuitem', { name: 'Compare with…' }).click();
  await seen(form(page));
  // By keys alone from here: the other run, and compare.
  await until('the recording is listed', async () =>
    (await form(page).innerText()).includes('other.mcap'),
  );
  await choose(studio, 'other.mcap');
  await press('Tab', 'Tab', 'Enter');
  await seen(lanes(page));
  const expected = compared(server.folder);
  assert.ok(expected.length > 3, expected.join('; '));
  assert.deepEqual(await listed(page), expected);
  await look(studio, 'runs');
  // To a difference by the keyboard: both are shown there, and the run of the window, too.
  await lanes(page).first().focus();
  const later = expected.findIndex((one) => parseFloat(one.split(' ').at(-1) ?? '') > 1);
  assert.ok(later > 0);
  for (let at = 0; at < later; ++at) await press('ArrowDown');
  await press('Enter');
  const t = (expected[later] ?? '').split(' ').at(-1) ?? '';
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
    /in A began no actor "findwallangle"; did you mean findWallAngle\?/,
  );
  await press('Control+a');
  await type('findWallAngle');
  await press('Enter');
  await seen(lanes(page));
  assert.deepEqual(
    await listed(page),
    compared(server.folder, '--align', 'actor', 'findWallAngle'),
  );
  await reads(lanes(page).first(), /s of A, .* s of B/);
  // The other one in the whole window; the run that was shown is a recording by then.
  await page.getByRole('button', { name: 'Show B here' }).click();
  await seen(bar(page));
  const a = form(page).getByRole('combobox', { name: 'A', exact: true });
  await until('A is named', async () => (await a.inputValue()).endsWith('run-1.mcap'));
  await seen(lanes(page));
});

test('from the tree, the same twice has no difference', wall, async (studio) => {
  const { page, press, server } = studio;
  execFileSync('cp', [recordOther(server.folder), join(server.folder, 'again.mcap')]);
  const row = page.getByRole('treeitem', { name: /other\.mcap/ });
  await row.click({ button: 'right' });
  await page.getByRole('menuitem', { name: 'Compare with…' }).click();
  await seen(form(page));
  const a = form(page).getByRole('combobox', { name: 'A', exact: true });
  await a.focus();
  // Nothing has run: that is told.
  await page.getByRole('button', { name: 'Compare', exact: true }).click();
  await reads(page.getByRole('alert'), /nothing has run yet/);
  await a.focus();
  for (let at = 0; (await a.inputValue()) !== 'again.mcap'; ++at) {
    assert.ok(at < 10);
    await press('ArrowDown');
  }
  await page.getByRole('button', { name: 'Compare', exact: true }).click();
  await seen(page.getByText('No difference: both runs are the same.'));
  assert.equal(await page.locator('.runs__robot').count(), 2);
});
