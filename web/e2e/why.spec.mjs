// Why something in a run is as it is, asked by keys and menus; and the recording that answers.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, readdirSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { look } from './support/axe.mjs';
import { runTo } from './support/runs.mjs';
import { root, vagusProgram } from './support/server.mjs';
import { focused, reads, seen, test, until } from './support/studio.mjs';
/** @import { Page, Studio } from './support/studio.mjs' */

/** As the editor of bumper counts it, whose script begins in the line of its node. */
function lineOfBumper(/** @type {string} */ part) {
  const file = readFileSync(join(root, 'examples/carbot/carbot.aesl'), 'utf8');
  const script = file.slice(file.indexOf('name="bumper"')).split('\n');
  return 1 + script.findIndex((line) => line.includes(part));
}

const wall = { words: ['--example', 'follow-wall'] };

const links = (/** @type {Page} */ page) =>
  page.getByRole('list', { name: 'What it followed from, the newest first' }).getByRole('button');
const bar = (/** @type {Page} */ page) => page.getByRole('region', { name: 'Looking back' });
const world = (/** @type {Page} */ page) => page.getByRole('application', { name: /^World/ });

/** On to the actor that begins next. */
async function toNext(/** @type {Studio} */ { page, press, type }, /** @type {string} */ actor) {
  await press('Control+k');
  await type('plan: on to the next actor');
  await press('Enter');
  await reads(page.locator('.pactive'), new RegExp(actor));
}

/** Its texts, once it is answered. */
async function answered(/** @type {Page} */ page, /** @type {RegExp} */ question) {
  await seen(page.getByRole('heading', { name: question }));
  await seen(links(page));
  return links(page).allInnerTexts();
}

/** Runs the largest recording of the project again. */
function replayed(/** @type {string} */ folder) {
  const all = readdirSync(folder, { recursive: true, encoding: 'utf8' })
    .filter((one) => one.endsWith('.mcap'))
    .map((one) => join(folder, one));
  const [largest = ''] = all.sort((one, other) => statSync(other).size - statSync(one).size);
  return execFileSync(vagusProgram, ['replay', largest], { encoding: 'utf8' });
}

/** The way back to now is a button of its own colour, and nothing at the top is cut off. */
async function lookingBackIsSeen(/** @type {Studio} */ { page, button }) {
  const colours = [button('Back to now'), button(/^To the step of the plan before/)].map((one) =>
    one.evaluate((is) => getComputedStyle(is).backgroundColor),
  );
  const [back, step] = await Promise.all(colours);
  assert.notEqual(back, step);
  const top = page.locator('header.topbar');
  assert.ok(await top.evaluate((is) => is.scrollWidth <= is.clientWidth), 'the top is cut off');
}

test('the robot bumped: why, back to that instant, and its line', wall, async (studio) => {
  const { page, press, type, server } = studio;
  // At 80 s a plank falls before the robot, at 82.5 s it bumps into it and is about to back up.
  await runTo(studio, 'backupCollision');
  await toNext(studio, 'findWallAngle');
  // By keys: the only robot in the world.
  await world(page).focus();
  await press('w');
  const wheels = await answered(page, /^Why do the wheels of carbot turn as they do\? now/);
  assert.match(wheels[0] ?? '', /the script of drive called drive\./);
  await focused(links(page).first());
  // By the button below the drawing; the run is paused at the instant at which the actor begins.
  await studio.button('Why findWallAngle?').click();
  const begun = await answered(page, /^Why is findWallAngle active, or why did it end\?/);
  assert.match(begun[0] ?? '', /the actor backupCollision ended with ForwardSuccessful/);
  // By the menu of the drawing: the actor that backed up. Its chain ends at what fell there.
  await page.getByRole('group', { name: /^backupCollision, actor/ }).click({ button: 'right' });
  await page.getByRole('menuitem', { name: 'Why?' }).click();
  const actor = await answered(page, /^Why is backupCollision active, or why did it end\?/);
  assert.match(actor[0] ?? '', /the actor backupCollision ended with/);
  assert.match(actor.at(-2) ?? '', /carbot touched "plank"/);
  assert.match(actor.at(-1) ?? '', /the timeline of the world put "plank" there[^]*80\.000/);
  await look(studio, 'why');
  // By keys to the supervisor that raised it: everything shows that instant.
  const raised = actor.findIndex((line) => line.includes('wallTouch raised TouchSensorPressed'));
  await links(page).first().focus();
  for (let at = 0; at < raised; ++at) await press('ArrowDown');
  await press('Enter');
  await reads(bar(page), /Everything shows 82\.4\d\d s/);
  await lookingBackIsSeen(studio);
  // The line of the script that told it.
  const emitted = links(page).filter({ hasText: 'the script of bumper emitted touch.pressed' });
  await reads(emitted, new RegExp(`bumper:${lineOfBumper('emit touch.pressed')}\\b`));
  await emitted.click();
  const lines = studio.editor('bumper').locator('.cm-line');
  await until('the line is in sight', async () =>
    (await lines.allInnerTexts()).some((line) => line.includes('emit touch.pressed')),
  );
  // A question while looking back is about then: it was still following the wall.
  await world(page).focus();
  await press('w');
  const then = await answered(
    page,
    /^Why do the wheels of carbot turn as they do\? at 82\.4\d\d s/,
  );
  assert.match(then.join('\n'), /the actor followWall of the plan sent/);
  await press('Escape');
  // A variable, by the key of its row.
  await page.getByRole('tab', { name: 'Variables' }).click();
  await page.getByRole('searchbox', { name: 'Find in all nodes' }).fill('token');
  await page
    .getByRole('listitem')
    .filter({ hasText: /^token/ })
    .focus();
  await press('w');
  await answered(page, /^Why has drive\.token its value\?/);
  // The end.
  await press('Shift+F5', 'Control+k');
  await type('why did the run end');
  await press('Enter');
  const end = await answered(page, /^Why did the run end\?/);
  assert.match(end.join('\n'), /somebody ended the run/);
  assert.match(replayed(server.folder), /no difference/);
});

test(
  'while the drawing shows a line of the answer, the answer stays in sight',
  wall,
  async (studio) => {
    const { page, layout, button } = studio;
    await runTo(studio, 'backupCollision');
    await layout('Draw');
    // It bumped at the upper right: the picture of its camera is not over that.
    await seen(page.locator('.world__camera[data-low]'));
    await button('Why backupCollision?').click();
    const raised = links(page).filter({ hasText: 'wallTouch raised TouchSensorPressed' });
    await raised.click();
    await seen(bar(page));
    await seen(page.getByRole('region', { name: /drawn$/ }));
    assert.ok(await raised.isVisible());
    // Who clicks another element goes on with that.
    await page.getByRole('group', { name: /^followWall, actor/ }).click();
    await seen(page.getByRole('region', { name: 'Properties' }).getByText('followWall').first());
    assert.ok(!(await raised.isVisible()));
  },
);

test('what is done by hand and changed is the same again', wall, async (studio) => {
  const { page, press, type, server } = studio;
  await runTo(studio, 'findWallAngle');
  // While the plan is held: the robot is moved, and a script gets another number.
  await world(page).focus();
  await press('Shift+N', 'Shift+ArrowRight', 'Shift+ArrowUp');
  const drive = studio.editor('drive');
  await drive.getByText('const PATIENCE = 15').click();
  await press('End');
  await type('0');
  await press('Alt+Shift+u');
  await reads(page.locator('.events__list'), /loaded drive/);
  await toNext(studio, 'parallelToWall');
  await press('Shift+F5', 'Control+k');
  await type('simulation back to its start');
  await press('Enter');
  await until('its recording has its end', () =>
    Promise.resolve(/^[^\n]*no difference$/m.test(replayed(server.folder))),
  );
});

test('what cannot be answered says why', wall, async ({ page, press, layout }) => {
  await layout('Debug');
  await page.getByRole('group', { name: /^followWall, actor/ }).focus();
  await press('Space', 'w');
  await reads(
    page.getByRole('alert'),
    /actor followWall: no actor had begun by then; let the plan run/,
  );
  // Of a thing in the world nothing can be asked, and the key says of what.
  await world(page).focus();
  await press('n', 'w');
  await reads(page.getByRole('log', { name: 'Messages' }), /Select a robot of the run first\./);
});
