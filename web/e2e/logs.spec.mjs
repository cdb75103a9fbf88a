// Log points put into a run that was: what variables held each time, each a click from its instant.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { look } from './support/axe.mjs';
import { lastRecording, runTo } from './support/runs.mjs';
import { root, vagusProgram } from './support/server.mjs';
import { gone, openWindow, reads, seen, test, until } from './support/studio.mjs';
/** @import { Page, Studio } from './support/studio.mjs' */

const wall = { words: ['--example', 'follow-wall'] };

const bar = (/** @type {Page} */ page) => page.getByRole('region', { name: 'Looking back' });
const hits = (/** @type {Page} */ page) =>
  page.getByRole('list', { name: /^Times that they were reached/ }).getByRole('listitem');
const points = (/** @type {Page} */ page) =>
  page.getByRole('list', { name: 'Log points' }).getByRole('listitem');
const values = (/** @type {Page} */ page, /** @type {string} */ place) =>
  page.getByRole('textbox', { name: `Values at ${place}` });

/** What the command line finds there: instants, and values. */
function logged(
  /** @type {string} */ folder,
  /** @type {string} */ where,
  /** @type {string} */ what,
) {
  const words = ['replay', lastRecording(folder), '--json', '--log', where, what];
  return execFileSync(vagusProgram, words, {
    encoding: 'utf8',
    stdio: ['ignore', 'pipe', 'ignore'],
  })
    .split('\n')
    .filter((line) => line.includes('"at"'))
    .map((line) => /** @type {{ t: number, values: Record<string, unknown> }} */ (JSON.parse(line)))
    .map(({ t, values }) => `${t.toFixed(3)} ${Object.values(values).join(' ')}`);
}

/** Time and values of the rows. */
async function listed(/** @type {Page} */ page) {
  const rows = await hits(page).all();
  return Promise.all(
    rows.map(async (row) => {
      const time = await row.locator('time').innerText();
      return [time, ...(await row.locator('code').allInnerTexts())].join(' ');
    }),
  );
}

/** The caret on the line of drive's script with that text, found by its words. */
async function toLine(
  /** @type {Studio} */ { page, press, type, editor },
  /** @type {string} */ text,
) {
  await editor('drive').click();
  await press('Control+f');
  await seen(page.getByRole('textbox', { name: 'Find', exact: true }));
  await type(text);
  await press('Enter');
}

/** The line of the first log point. */
const lineOf = async (/** @type {Page} */ page) =>
  /drive:(\d+)/.exec((await points(page).first().innerText()) ?? '')?.[1];

/** What is read at the field that has the keyboard. */
const isTyped = (/** @type {import('./support/studio.mjs').Locator} */ field) =>
  until('the keyboard is there', () => field.evaluate((is) => is === document.activeElement));

test('what drive held each time it was told to steer', wall, async (studio) => {
  const { page, press, type, server } = studio;
  await runTo(studio, 'backupCollision');
  // By keys alone: an instant before, a line of the script, the log point, its values.
  await press('Alt+F10');
  await seen(bar(page));
  await toLine(studio, 'call drive.steer');
  await press('Shift+F9');
  const typed = page.getByRole('textbox', { name: /^Values at drive:\d+/ });
  await isTyped(typed);
  // What is wrong is said where it is typed: brackets by the page, names by the server.
  await type('token + , patiens');
  await press('Enter');
  await reads(page.getByRole('alert'), 'expected a value after “+”');
  await press('Control+a');
  await type('token, patiens');
  await press('Enter');
  await reads(page.getByRole('alert'), /has no variable "patiens"; did you mean patience\?/);
  await press('Backspace');
  await type('ce');
  await press('Enter');
  await seen(hits(page));
  await gone(page.getByRole('alert'));
  // The same as on the command line, which counts lines of the file.
  const lines = readFileSync(join(root, 'examples/carbot/carbot.aesl'), 'utf8').split('\n');
  const line = lines.findIndex((one) => one.includes('call drive.steer')) + 1;
  const expected = logged(server.folder, `drive:${line}`, 'token, patience');
  assert.ok(expected.length > 2, `${expected.length} hits`);
  await reads(points(page).first(), new RegExp(`${expected.length} hits`));
  // Its line has a mark, and says what it logs.
  const marked = page.locator('.disc--log');
  await seen(marked);
  assert.equal(await marked.getAttribute('title'), `Log point on line ${await lineOf(page)}`);
  await reads(studio.editor('drive'), /call drive\.steer[^\n]*logs token, patience/);
  const rows = await listed(page);
  assert.ok(rows.length > 2);
  assert.deepEqual(rows, expected.slice(0, rows.length));
  await look(studio, 'logs');
  // To the second of them: everything shows its instant.
  await press('ArrowDown', 'ArrowDown', 'Enter');
  const [second = ''] = (expected[1] ?? '').split(' ');
  await reads(bar(page), new RegExp(`Everything shows ${second} s`));
  await isTyped(hits(page).nth(1));
  // The table, for other programs.
  await page.getByRole('button', { name: 'The table for other programs' }).click();
  await page.getByRole('menuitem', { name: 'Copy as CSV' }).click();
  await until('it is in the clipboard', async () =>
    (await page.evaluate(() => navigator.clipboard.readText())).startsWith(
      't,place,token,patience\r\n',
    ),
  );
  // Another run has other hits: these are not shown any more, and can be asked again.
  await page.getByRole('button', { name: 'Run from here' }).click();
  await reads(points(page).first(), /Not asked of this run\./);
  await gone(hits(page));
  await press('F8');
  await page.getByRole('button', { name: 'Ask', exact: true }).click();
  await reads(points(page).first(), /\d+ hits?|Not reached/);
  await page.getByRole('button', { name: /^Remove the log point/ }).click();
  await gone(marked);
});

test('what a plan held, in its drawing', wall, async (studio) => {
  const { page, press, type, server, t } = studio;
  await runTo(studio, 'backupCollision');
  const element = (/** @type {string} */ name) =>
    page.getByRole('group', { name: new RegExp(`^${name}, `) });
  // By the menu: an actor, when it ends.
  await element('findWallAngle').click({ button: 'right' });
  await page.getByRole('menuitem', { name: /log values here/ }).click();
  await isTyped(values(page, 'findWallAngle begins'));
  await page.getByRole('combobox', { name: 'When findWallAngle is looked at' }).focus();
  await press('ArrowDown');
  await press('Tab');
  await type('wallangle, wallangle / 2');
  await press('Enter');
  await seen(hits(page));
  assert.deepEqual(
    await listed(page),
    logged(server.folder, '@findWallAngle.leave', 'wallangle, wallangle / 2'),
  );
  // By keys: an actor that was not reached, and a supervisor.
  await element('turnAfterWallLost').focus();
  await press('Space', 'Shift+F9');
  await isTyped(values(page, 'turnAfterWallLost begins'));
  await type('walldist');
  await press('Enter');
  await reads(points(page).nth(1), /Not reached in this run\./);
  await element('wallTouch').focus();
  await press('Space', 'Shift+F9');
  await isTyped(values(page, 'wallTouch raises'));
  await type('walldist');
  await press('Enter');
  await reads(points(page).nth(2), /1 hit/);
  // Hits of all points are in the order of time.
  const times = (await listed(page)).map((row) => parseFloat(row));
  assert.deepEqual(
    [...times].sort((one, other) => one - other),
    times,
  );
  const [last] = await hits(page)
    .all()
    .then((all) => all.slice(-1));
  assert.ok(last);
  await last.click();
  await reads(bar(page), /Everything shows 82\.4\d\d s/);
  await look(studio, 'logs of a plan');
  // Another page has its own, and so has this one once it is loaded again.
  const other = await openWindow(t, server, {});
  await other.layout('Debug');
  await other.page.getByRole('group', { name: /^followWall, / }).focus();
  await other.press('Space', 'Shift+F9');
  await isTyped(values(other.page, 'followWall begins'));
  await other.type('walldist');
  await other.press('Enter');
  await reads(points(other.page).first(), /hit/);
  assert.equal(await points(other.page).count(), 1);
  assert.equal(await points(page).count(), 3);
  // A recording that is gone is said to be.
  rmSync(lastRecording(server.folder));
  await other.page.getByRole('button', { name: 'Ask again' }).click();
  await reads(
    other.page.getByRole('alert'),
    /run-\d+\.mcap: the recording of this run is not there/,
  );
  await gone(hits(other.page));
  await other.page.getByRole('button', { name: /^Remove the log point/ }).click();
  await seen(other.page.getByText('No log points.'));
  await page.reload();
  await seen(page.getByText('No log points.'));
});
