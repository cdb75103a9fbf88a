// From an instant of the past the run goes on differently: what was before stays, what is changed
// counts from there, and both runs can be run again.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { readFileSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { look } from './support/axe.mjs';
import { runTo } from './support/runs.mjs';
import { vagusProgram } from './support/server.mjs';
import { boxOf, gone, reads, seen, test, until } from './support/studio.mjs';
/** @import { Page, Studio } from './support/studio.mjs' */

const wall = { words: ['--example', 'follow-wall'] };
const bar = (/** @type {Page} */ page) => page.getByRole('region', { name: 'Looking back' });
const slider = (/** @type {Page} */ page) =>
  page.getByRole('slider', { name: 'Instant that is shown' });
const clock = async (/** @type {Page} */ page) =>
  parseFloat(await page.locator('.clock__time').innerText());

/** Recordings of the project, in the order of their numbers. */
function recordings(/** @type {string} */ folder) {
  const number = (/** @type {string} */ one) => Number(/run-(\d+)\.mcap$/.exec(one)?.[1]);
  return readdirSync(folder, { recursive: true, encoding: 'utf8' })
    .filter((one) => one.endsWith('.mcap'))
    .sort((one, other) => number(one) - number(other))
    .map((one) => join(folder, one));
}

/** Back to the step of the plan before, some times. */
async function back(/** @type {Studio} */ { page, press }, /** @type {number} */ steps) {
  await page.getByRole('tab', { name: 'Timeline' }).click();
  await press('Alt+F10');
  await seen(bar(page));
  await slider(page).focus();
  const shown = async () => Number(await slider(page).getAttribute('aria-valuenow'));
  let at = await shown();
  for (let step = 1; step < steps; ++step) {
    await press('Shift+ArrowLeft');
    await until('an earlier instant is shown', async () => (await shown()) < at);
    at = await shown();
  }
  return at;
}

test('the robot bumped: back, another threshold, and on from there', wall, async (studio) => {
  const { page, press, type, server } = studio;
  await runTo(studio, 'backupCollision');
  const bumped = await clock(page);
  assert.ok(bumped > 82 && bumped < 84);
  const at = await back(studio, 2);
  assert.ok(at < bumped, `${at} s`);
  await look(studio, 'continue');
  // Another number in the script of the node that drives.
  const drive = studio.editor('drive');
  await drive.getByText('PATIENCE').first().click();
  await press('Home');
  for (let at = 0; at < 'const PATIENCE = 15'.length; ++at) await press('ArrowRight');
  await type('0');
  // The script offers it, too.
  await page.getByRole('button', { name: 'Run from here F5' }).click();
  await gone(bar(page));
  await until('it runs on from there', async () => (await clock(page)) > at);
  // Its past is that of the run before: an actor of the first seconds is on the timeline.
  await press('F8');
  await slider(page).focus();
  await press('Home');
  const box = await boxOf(slider(page));
  await page.mouse.click(box.x + 10, box.y + 8);
  await seen(bar(page));
  await reads(page.locator('.pactive'), /searchFirstWall/);
  await press('Escape');
  await gone(bar(page));
  // A question is about this run now, and about the one that is shown.
  await press('Shift+F5', 'Control+k');
  await type('simulation back to its start');
  await press('Enter');
  await until('both can be run again', () =>
    Promise.resolve(
      recordings(server.folder).filter((one) =>
        /no difference$/m.test(execFileSync(vagusProgram, ['replay', one], { encoding: 'utf8' })),
      ).length >= 2,
    ),
  );
  const [before = '', after = ''] = recordings(server.folder);
  const { stdout } = spawnSync(vagusProgram, ['compare', before, after, '--json'], {
    encoding: 'utf8',
  });
  const first = Math.min(
    ...JSON.parse(stdout).lanes.flatMap((/** @type {any} */ lane) =>
      lane.difference ? [lane.difference.a_t] : [],
    ),
  );
  assert.ok(Number.isFinite(first), 'the script of drive was loaded again');
  assert.ok(first >= at, `the runs part at ${first} s, not before ${at} s`);
});

test('while looking back nothing that changes the run is offered', wall, async (studio) => {
  const { page, press, button } = studio;
  await runTo(studio, 'findWallAngle');
  await back(studio, 1);
  const options = page.locator('.palette__item');
  const why = async (/** @type {string} */ title) => {
    await press('Control+k');
    await page.getByRole('combobox', { name: 'Type a command' }).fill(title);
    const said = await options.filter({ hasText: title }).first().innerText();
    await press('Escape');
    return said;
  };
  for (const title of ['Run all nodes', 'Upload to all nodes', 'Plan: on to the next actor'])
    assert.match(await why(title), /You are looking back/);
  for (const title of ['Stop all nodes', 'Stop the plan', 'Run all tests of the project'])
    assert.doesNotMatch(await why(title), /You are looking back/);
  assert.ok(await button('Upload').first().isDisabled());
  await press('Alt+Shift+u');
  await seen(page.getByText(/^Upload to the node: You are looking back/));
  // Nor is a value changed, which the key of its row says.
  await page.getByRole('tab', { name: 'Variables' }).click();
  await page.getByRole('searchbox', { name: 'Find in all nodes' }).fill('patience');
  await page
    .getByRole('listitem')
    .filter({ hasText: /^patience/ })
    .focus();
  await press('Enter');
  await seen(page.getByText(/^Change .*patience: You are looking back/));
});

test('without its server no instant is claimed that is not shown', wall, async (studio) => {
  const { page, press, server } = studio;
  await runTo(studio, 'findWallAngle');
  const at = await back(studio, 1);
  await reads(bar(page), new RegExp(`Everything shows ${at.toFixed(3)} s`));
  await server.program.stop('SIGKILL');
  await seen(page.getByText(/^Lost the studio/));
  await press('ArrowLeft');
  await reads(
    bar(page),
    new RegExp(`${(at - 0.02).toFixed(3)} s is shown when the studio is back`),
  );
  studio.complaints.length = 0; // of a server that does not answer
});

test('a run becomes a test, which passes', wall, async (studio) => {
  const { page, press, server } = studio;
  await runTo(studio, 'parallelToWall');
  await press('Shift+F5');
  await page.getByRole('tab', { name: 'Timeline' }).click();
  await page.getByRole('button', { name: 'Keep the run as a test' }).click();
  await reads(page.locator('.dock__doc, .cm-content').last(), /vagus-test\/1/);
  const path = readdirSync(server.folder, { recursive: true, encoding: 'utf8' }).find((one) =>
    one.endsWith('WallFollow.test.json'),
  );
  assert.ok(path !== undefined);
  const said = execFileSync(vagusProgram, ['test', join(server.folder, path)], {
    encoding: 'utf8',
    cwd: server.folder,
  });
  assert.match(said, /1 of 1 runs as expected/);
});

test('a run that was changed on its way is kept as a test that passes', wall, async (studio) => {
  const { page, press, type, server, layout } = studio;
  await runTo(studio, 'parallelToWall');
  await back(studio, 1);
  // A run from the start at this speed does not reach the wall in time. This run already has.
  await layout('Draw');
  await page.getByRole('group', { name: /^searchFirstWall, actor/ }).click();
  await page.getByRole('tab', { name: 'Properties' }).click();
  const speed = page.getByRole('region', { name: 'Properties' }).getByLabel('speed');
  await speed.click();
  await press('Control+a');
  await type('5');
  await press('Enter');
  const notice = page.getByRole('status').filter({ hasText: '“Run from here” uses this change.' });
  await notice.getByRole('button', { name: 'Run from here' }).click();
  await gone(bar(page));
  await seen(page.getByText('Paused by the breakpoint parallelToWall'));
  await press('Shift+F5');
  await page.getByRole('tab', { name: 'Timeline' }).click();
  await page.getByRole('button', { name: 'Keep the run as a test' }).click();
  await seen(page.getByText(/expects what your files do from the start/));
  const path = readdirSync(server.folder, { recursive: true, encoding: 'utf8' }).find((one) =>
    one.endsWith('WallFollow.test.json'),
  );
  assert.ok(path !== undefined);
  // At 5 cm/s it does not come to the wall in that time: there is nothing but the way to it.
  const kept = JSON.parse(readFileSync(join(server.folder, path), 'utf8'));
  assert.deepEqual(kept.expect[0], { order: ['searchFirstWall'] });
  assert.deepEqual(kept.expect[2], { always: 'contact == 0', help: 'touches nothing' });
  await press('F5');
  await reads(page.getByRole('tabpanel', { name: 'Tests' }), /1 run as expected/);
});

test('a recording is opened, looked back into, asked, and continued', wall, async (studio) => {
  const { page, press, server, layout } = studio;
  await layout('Script');
  const project = await until('the project is a folder', () => {
    const all = readdirSync(server.folder, { recursive: true, encoding: 'utf8' });
    const plan = all.find((one) => one.endsWith('WallFollow.plan.json'));
    return plan === undefined ? undefined : dirname(join(server.folder, plan));
  });
  const recording = join(project, 'seen.mcap');
  const words = [
    'plan',
    'run',
    'WallFollow.plan.json',
    '--world',
    'hall.world.json',
    '--clock',
    'virtual',
  ];
  spawnSync(vagusProgram, [...words, '--max-time', '60', '--quiet', '--record', recording], {
    cwd: project,
  });
  await page.getByRole('treeitem', { name: /^seen\.mcap/ }).dblclick();
  await layout('Debug');
  // The plan had 60 s, and somewhat more to end its work; now it has as long as it takes.
  await until('it is at its end', async () => (await clock(page)) >= 60);
  assert.ok((await clock(page)) < 61);
  await seen(page.getByRole('button', { name: 'Continue' }));
  await page.getByRole('tab', { name: 'Timeline' }).click();
  await seen(slider(page));
  await slider(page).focus();
  await press('Home');
  const box = await boxOf(slider(page));
  await page.mouse.click(box.x + 10, box.y + 8);
  await seen(bar(page));
  await reads(page.locator('.pactive'), /searchFirstWall/);
  // What happened on the bus while it was run again is on the timeline, and in the list of then.
  await reads(page.locator('.tl__labels'), /Events[^]*drive/);
  const t = Number(await slider(page).getAttribute('aria-valuenow'));
  await page.getByRole('tab', { name: /^Events/ }).click();
  await until('the newest event is of then', async () => {
    const newest = await page.locator('.events__list time').first().innerText();
    return Number(newest) <= t;
  });
  await page.getByRole('tab', { name: 'Timeline' }).click();
  await page.getByRole('group', { name: /^searchFirstWall, actor/ }).click({ button: 'right' });
  await page.getByRole('menuitem', { name: 'Why?' }).click();
  await seen(page.getByRole('heading', { name: /^Why is searchFirstWall active/ }));
  await seen(page.getByRole('list', { name: 'What it followed from, the newest first' }));
  await page.getByRole('button', { name: 'Run from here' }).click();
  await gone(bar(page));
  await until('it runs', async () => (await clock(page)) > 2);
});

test(
  'a script without a plan is looked back at by two seconds, by keys alone',
  { words: ['--example', 'thymio'] },
  async (studio) => {
    const { page, press, command, editor } = studio;
    await seen(editor('thymio-II'));
    await press('F5');
    await until('it has run for some seconds', async () => (await clock(page)) > 4);
    await press('F8');
    await seen(page.getByRole('button', { name: 'Continue' }));
    const now = await clock(page);
    await command('Look back 2 s');
    await reads(bar(page), /2\.0 s ago/);
    await command('Look back 2 s');
    await reads(bar(page), /4\.0 s ago/);
    await press('F5');
    await gone(bar(page));
    await until('it runs on from there', async () => (await clock(page)) < now);
  },
);

test('back to an instant, and it stays there', wall, async (studio) => {
  const { page, press, type } = studio;
  await runTo(studio, 'parallelToWall');
  const at = await back(studio, 1);
  await press('Control+k');
  await type('go back to this instant');
  await press('Enter');
  await gone(bar(page));
  await until('it is paused there', async () => Math.abs((await clock(page)) - at) < 0.06);
  await seen(page.getByRole('button', { name: 'Continue' }));
});

test(
  'F5 while looking back runs from there; nothing to go back to says why',
  wall,
  async (studio) => {
    const { page, press, type } = studio;
    await press('Control+k');
    await type('run from here');
    await reads(page.getByRole('dialog'), /Look back into a run of the simulator first/);
    await press('Escape', 'Escape');
    await runTo(studio, 'findWallAngle');
    const at = await back(studio, 1);
    await press('F5');
    await gone(bar(page));
    await until('it has gone on', async () => (await clock(page)) > at);
  },
);

test('a run before this one is opened from the timeline, by keys', wall, async (studio) => {
  const { page, press, type } = studio;
  await runTo(studio, 'findWallAngle');
  const first = await clock(page);
  await press('Control+k');
  await type('simulation back to its start');
  await press('Enter');
  await until('it is at its start', async () => (await clock(page)) === 0);
  // A longer one.
  await page.getByRole('group', { name: /^findWallAngle, actor/ }).focus();
  await press('F9');
  await page.getByRole('group', { name: /^parallelToWall, actor/ }).focus();
  await press('Space', 'F9', 'F5');
  await seen(page.getByText('Paused by the breakpoint parallelToWall'));
  await until('the clock shows a later instant', async () => (await clock(page)) > first);
  await press('Control+k');
  await type('open a run before');
  await press('Enter');
  const runs = page.getByRole('menuitem', { name: /^Run \d+, until/ });
  await seen(runs.first());
  assert.equal(await runs.count(), 1, 'not the one that is there');
  await press('ArrowDown', 'Enter');
  await until('the first run is there, at its end', async () => (await clock(page)) === first);
  // Its past comes after its clock.
  await seen(slider(page).locator('text', { hasText: 'searchFirstWall' }));
  await press('Alt+F10');
  await seen(bar(page));
  await reads(page.locator('.pactive'), /searchFirstWall/);
});

test('a variable of then is set for the run from there', wall, async (studio) => {
  const { page, press, type } = studio;
  await runTo(studio, 'parallelToWall');
  await page.getByRole('switch', { name: 'What it does' }).click();
  const at = await back(studio, 1);
  const live = page.getByRole('complementary', { name: 'What the plan does' });
  const distance = live.getByLabel('Value of walldist');
  const set = async () => {
    assert.equal(await distance.inputValue(), '30');
    await distance.click();
    await press('Control+a');
    await type('60');
    await press('Enter');
  };
  await set();
  const notice = page.getByRole('status').filter({ hasText: 'sets walldist to 60' });
  await seen(notice.getByText('it is 30 at this instant'));
  await notice.getByRole('button', { name: 'Keep 30' }).click();
  await gone(notice);
  await set();
  // searchFirstWall drives as far as it gets; its supervisor reads the variable before each check.
  assert.doesNotMatch(await notice.innerText(), /read walldist/);
  await look(studio, 'variable-then');
  await notice.getByRole('button', { name: 'Run from here' }).click();
  await gone(bar(page));
  await seen(page.getByText('Paused by the breakpoint parallelToWall'));
  await until('it runs on with it', async () => (await distance.inputValue()) === '60');
  assert.ok((await clock(page)) >= at);
});

test('a change of the active actor counts from where it started', wall, async (studio) => {
  const { page, press, type, layout } = studio;
  await runTo(studio, 'parallelToWall');
  const at = await back(studio, 1); // where searchFirstWall ended
  await layout('Draw');
  const fields = page.getByRole('region', { name: 'Properties' });
  const change = async (/** @type {RegExp} */ actor, /** @type {string} */ label, to = '') => {
    await page.getByRole('group', { name: actor }).click();
    await page.getByRole('tab', { name: 'Properties' }).click();
    await fields.getByLabel(label).click();
    await press('Control+a');
    await type(to);
    await press('Enter');
  };
  const notice = page.getByRole('status').filter({ hasText: '“Run from here” uses this change.' });
  // The one that comes next takes its values then.
  await change(/^followWall, actor/, 'gain', '2');
  await seen(notice);
  assert.doesNotMatch(await notice.innerText(), /keeps the values/);
  await change(/^searchFirstWall, actor/, 'speed', '10');
  await seen(notice.getByText('searchFirstWall keeps the values with which it started at 0.0 s.'));
  await look(studio, 'kept');
  await notice.getByRole('button', { name: 'Run from 0.0 s' }).click();
  await gone(bar(page));
  await seen(page.getByText('Paused by the breakpoint parallelToWall'));
  // At half its speed it takes twice as long to the wall.
  const reached = await clock(page);
  assert.ok(reached > 2 * at, `${reached} s, after ${at} s`);
  // Later in a run it is the instant at which the actor started.
  const intoSearch = async (/** @type {string} */ spread) => {
    await back(studio, 1);
    await slider(page).focus();
    await press(...Array(25).fill('ArrowRight')); // 0.5 s: the robot has stopped, and looks around
    await reads(page.locator('.pactive'), new RegExp(`findWallAngle[^]*spread ${spread}`));
  };
  await intoSearch('120');
  await layout('Draw');
  await change(/^findWallAngle, actor/, 'spread', '80');
  await press('Control+s');
  await seen(page.getByText('Saved', { exact: true }));
  await seen(notice.getByText(/findWallAngle keeps the values with which it started at/));
  await notice.getByRole('button', { name: /^Run from [1-9]/ }).click();
  await gone(bar(page));
  await layout('Debug');
  await seen(page.getByText('Paused by the breakpoint parallelToWall'));
  await intoSearch('80');
});

test(
  'it bumped: another distance from where the actor read it, and a test of that',
  wall,
  async (studio) => {
    const { page, press, type, button, server } = studio;
    await runTo(studio, 'backupCollision'); // of 82.7 s: the plank that its sensor does not hear
    await page.getByRole('switch', { name: 'What it does' }).click();
    await press('Control+k');
    await type('Look back 2 s');
    await press('Enter');
    await reads(page.locator('.pactive'), /followWall[^]*distance 30/);
    const live = page.getByRole('complementary', { name: 'What the plan does' });
    await live.getByLabel('Value of walldist').click();
    await press('Control+a');
    await type('80');
    await press('Enter');
    const notice = page.getByRole('status').filter({ hasText: 'sets walldist to 80' });
    await seen(notice.getByText('followWall read walldist when it started at 76.1 s.'));
    await notice.getByRole('button', { name: 'Run from 76.1 s' }).click();
    await gone(bar(page));
    // The escape button of 120 s ends it. It has touched nothing, so the breakpoint was not met.
    await reads(live, /was interrupted/);
    assert.ok((await clock(page)) > 120);
    await page.getByRole('tab', { name: 'Timeline' }).click();
    await button('Keep the run as a test').click();
    // At this distance from its start it takes longer, so that is what the test expects.
    await seen(page.getByText(/expects what your files do from the start/));
    const path = readdirSync(server.folder, { recursive: true, encoding: 'utf8' }).find((one) =>
      one.endsWith('WallFollow.test.json'),
    );
    assert.ok(path !== undefined);
    const kept = JSON.parse(readFileSync(join(server.folder, path), 'utf8'));
    assert.deepEqual(kept.set, { walldist: 80 });
    assert.deepEqual(kept.expect[2], { always: 'contact == 0', help: 'touches nothing' });
    assert.deepEqual(kept.expect[3], { ends: 'Interrupted', by: 'escape' });
  },
);
