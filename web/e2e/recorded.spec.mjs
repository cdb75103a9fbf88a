// A recording that cannot be run again, as that of a real robot, is shown as it was recorded.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { cpSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { look } from './support/axe.mjs';
import { makeProject } from './support/robots.mjs';
import { root, temporaryFolder, vagusProgram } from './support/server.mjs';
import { boxOf, gone, reads, seen, test } from './support/studio.mjs';
/** @import { TestContext } from './support/studio.mjs' */

const plan = JSON.stringify({
  format: 'vagus-plan/1',
  name: 'Twice',
  start: { actor: 'first' },
  actors: {
    first: { template: 'Wait', in: { seconds: 2 }, states: { Done: 'second' } },
    second: { template: 'Wait', in: { seconds: 3 }, states: { Done: '@terminate' } },
  },
  layout: { first: [80, 96], second: [320, 96] },
});

/** A plan without a world cannot be run again by the studio either, and needs no robot here. */
function recorded(/** @type {TestContext} */ t) {
  const project = makeProject(t, { name: 'Monday' }, { 'Twice.plan.json': plan });
  const file = join(project.place, 'Twice.plan.json');
  const words = ['plan', 'run', file, '--clock', 'virtual', '--quiet'];
  execFileSync(vagusProgram, [...words, '--record', join(project.place, 'monday.mcap')]);
  return project;
}

test(
  'a recording that cannot be run again is looked at, and asked why',
  { prepare: recorded },
  async (studio) => {
    const { page, layout, button, press, command, place } = studio;
    await layout('Draw');
    // Opening a recording does not save unsaved changes: nobody asked for that.
    await command('Plan: new variable');
    await seen(page.getByText('Not saved'));
    await page.getByRole('tab', { name: 'Project' }).click();
    await page.locator('[role="treeitem"][data-path="monday.mcap"]').click();
    await seen(
      page.getByText(/^Showing what was recorded, without a run: .*a plan without a world/),
    );
    await seen(page.getByText('Showing monday.mcap.'));
    const active = (/** @type {string} */ name) => seen(button(`Why ${name}?`));
    assert.equal(readFileSync(join(place, 'Twice.plan.json'), 'utf8'), plan);
    await active('first');
    await button('To the next step of the plan').click();
    await active('second');
    await button('Why second?').click();
    const why = page.getByRole('tabpanel', { name: 'Why' });
    await reads(why, /the actor second began[^]*the actor first ended with Done/);
    await look(studio, 'the recording and its why');
    await page.reload();
    await seen(page.getByText('Showing monday.mcap.'));
    await seen(page.getByText('Everything shows 2.000 s.'));
    await press('Escape');
    await gone(page.getByText('Showing monday.mcap.'));
  },
);

/** Ten robots with a plan each, in a project that has another world. */
function recordedFleet(/** @type {TestContext} */ t) {
  const project = makeProject(t, { name: 'Sunday' }, {});
  for (const part of ['carbot', 'warehouse', 'vagus.json'])
    cpSync(join(root, 'examples', part), join(project.place, 'fleet', part), { recursive: true });
  const hall = join(project.place, 'fleet/warehouse/hall.world.json');
  const words = ['sim', hall, '--headless', '--speed', 'max', '--duration', '60'];
  execFileSync(vagusProgram, [...words, '--record', join(project.place, 'hall.mcap')]);
  return project;
}

test(
  'a recording of a fleet shows its world, and the plan and the why of the chosen robot',
  { prepare: recordedFleet },
  async (studio) => {
    const { page, layout, button, press } = studio;
    await layout('Draw');
    await page.getByRole('tab', { name: 'Project' }).click();
    await page.locator('[role="treeitem"][data-path="hall.mcap"]').click();
    await seen(page.getByText(/without a run: .*10 robots have projects of their own/));
    // Where its robots are, at any instant.
    const row = page.getByRole('table', { name: 'Things' }).getByRole('row', { name: /^r2 / });
    await reads(row, /1\.70\s*1\.00/);
    const robots = page.getByRole('combobox', { name: 'Robot whose plan is shown' });
    await reads(robots, /^r1\s*r2/);
    await button('To the next step of the plan').click();
    // The first robot to meet the others gives tasks; the others still wait, and one drives later.
    await seen(button('Why giveTask?'));
    await robots.focus();
    await press('ArrowDown');
    await button('Why meet?').click();
    const why = page.getByRole('tabpanel', { name: 'Why' });
    await reads(why, /r2: the actor meet began/);
    await look(studio, 'the recording of a fleet');
    // An event is asked of the robot on whose bus it was.
    const slider = page.getByRole('slider', { name: 'Instant that is shown' });
    const { x, y, width } = await boxOf(slider);
    await page.mouse.click(x + width / 2, y + 8);
    await page.getByRole('tab', { name: /^Events/ }).click();
    await page.getByText('r4/drive', { exact: true }).first().click();
    await press('w');
    await reads(why, /r4: the script of drive emitted drive\./);
    await press('Escape');
    await gone(page.getByText('Showing hall.mcap.'));
    await gone(row);
  },
);

/** A run that somebody else has recorded, and nothing else of it. */
function sent(/** @type {TestContext} */ t) {
  const folder = temporaryFolder(t);
  const file = join(folder, 'tuesday.mcap');
  const place = join(root, 'examples/follow-wall');
  const run = ['plan', 'run', join(place, 'WallFollow.plan.json'), '--clock', 'virtual', '--quiet'];
  const world = ['--world', join(place, 'hall.world.json'), '--max-time', '10'];
  // 5: its time was over.
  const { status } = spawnSync(vagusProgram, [...run, ...world, '--record', file]);
  assert.equal(status, 5);
  return { folder, words: [file] };
}

test('a recording from anywhere is a project of its files', { prepare: sent }, async (studio) => {
  const { page } = studio;
  const ended = () => reads(page.locator('.clock'), /10\.\d+ s[^]*Paused/);
  await seen(page.getByRole('tab', { name: /^WallFollow\.plan/ }));
  await ended();
  await page.getByRole('tab', { name: 'Project' }).click();
  for (const path of ['carbot/carbot.aesl', 'follow-wall/hall.world.json', 'tuesday.mcap'])
    await seen(page.locator(`[role="treeitem"][data-path="${path}"]`));
  await look(studio, 'the recording as a project');
  await page.reload();
  await ended();
  await seen(page.getByRole('button', { name: 'Why parallelToWall?' }));
});
