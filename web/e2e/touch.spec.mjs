// A tablet: what a finger does where a mouse would do it.
import assert from 'node:assert/strict';
import { makeProject, twoNodes } from './support/robots.mjs';
import { boxOf, focused, gone, reads, seen, test, until } from './support/studio.mjs';
import { handsIn, openWorld } from './support/world.mjs';
/** @import { Page, TestContext } from './support/studio.mjs' */

const tablet = { width: 1180, height: 820, touch: true };
const kPlan = JSON.stringify({
  format: 'vagus-plan/1',
  name: 'P',
  start: { actor: 'wait' },
  actors: {
    wait: { template: 'Wait', in: { seconds: 1 }, states: {} },
    log: { template: 'Log', in: { text: "'here'" }, states: { Done: '@terminate' } },
  },
  layout: { wait: [80, 96], log: [400, 200] },
});

/**
 * A finger that goes down, along and up; the browser decides what it means, as with a real one.
 * @param {Page} page
 * @param {readonly { x: number, y: number }[]} way
 */
async function swipe(page, way) {
  const session = await page.context().newCDPSession(page);
  const touch = (/** @type {any} */ type, /** @type {readonly object[]} */ touchPoints) =>
    session.send('Input.dispatchTouchEvent', {
      type,
      touchPoints: /** @type {any} */ (touchPoints),
    });
  await touch('touchStart', way.slice(0, 1));
  for (const point of way.slice(1)) await touch('touchMove', [point]);
  await touch('touchEnd', []);
  await session.detach();
}

/**
 * A finger that goes down and stays until what it asked for is there.
 * @param {Page} page
 * @param {import('./support/studio.mjs').Locator} on
 * @param {() => Promise<unknown>} meanwhile
 */
async function hold(page, on, meanwhile) {
  const { x, y, width, height } = await boxOf(on);
  const session = await page.context().newCDPSession(page);
  const at = { x: x + width / 2, y: y + height / 2 };
  await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [at] });
  await meanwhile();
  await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  await session.detach();
}

const drawn = {
  ...tablet,
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(t, { name: 'T', plan: 'P.plan.json' }, { 'P.plan.json': kPlan }),
};

test('a tap on a port lists what it may lead to, and the list stays', drawn, async (studio) => {
  const { page, layout } = studio;
  await layout('Draw');
  const wait = page.getByRole('group', { name: /^wait, actor Wait/ });
  await wait.getByRole('button', { name: /^Done leads nowhere/ }).tap();
  await page.getByRole('menuitem', { name: 'log', exact: true }).tap();
  await page
    .getByRole('img', { name: 'wait Done leads to log', exact: true })
    .waitFor({ state: 'attached' });
});

test(
  'a finger draws an arrow from a port to its target; the canvas stays where it is',
  drawn,
  async ({ page, layout }) => {
    await layout('Draw');
    const wait = page.getByRole('group', { name: /^wait, actor Wait/ });
    const log = page.getByRole('group', { name: /^log, actor Log/ });
    const port = await boxOf(wait.getByRole('button', { name: /^Done leads nowhere/ }));
    const [before, to] = [await boxOf(wait), await boxOf(log)];
    const from = { x: port.x + port.width / 2, y: port.y + port.height / 2 };
    const end = { x: to.x + 40, y: to.y + 20 };
    const between = [1, 2, 3].map((step) => ({
      x: from.x + ((end.x - from.x) * step) / 4,
      y: from.y + ((end.y - from.y) * step) / 4,
    }));
    await swipe(page, [from, ...between, end]);
    await page
      .getByRole('img', { name: 'wait Done leads to log', exact: true })
      .waitFor({ state: 'attached' });
    const after = await boxOf(wait);
    assert.deepEqual([after.x, after.y], [before.x, before.y]);
  },
);

test(
  'a tap beside a line sets its breakpoint, another one deletes it',
  {
    ...tablet,
    prepare: (/** @type {TestContext} */ t) =>
      twoNodes(t, { left: 'var a = 0\na = 1\na = 2\n', right: 'var b = 0\n' }, {}),
  },
  async ({ page, layout, editor }) => {
    await layout('Script');
    await seen(editor('left'));
    const gutter = page.locator('.cm-breaks').first();
    const second = page.locator('.cm-lineNumbers .cm-gutterElement').filter({ hasText: /^2$/ });
    const [beside, line] = [await boxOf(gutter), await boxOf(second.first())];
    assert.ok(beside.width >= 32, `a finger is wider than ${beside.width} px`);
    const at = /** @type {const} */ ([beside.x + beside.width / 2, line.y + line.height / 2]);
    const disc = page.locator('.cm-breaks .disc[title^="Breakpoint on line 2"]');
    await page.touchscreen.tap(...at);
    await seen(disc);
    await until('it is the second line', async () => {
      const { y, height } = await boxOf(disc);
      return y >= line.y && y + height <= line.y + line.height;
    });
    await page.touchscreen.tap(...at);
    await gone(disc);
  },
);

test(
  'a newcomer opens an example, draws an actor, connects it and presses Run',
  { width: 1024, height: 768, touch: true },
  async ({ page, button, press }) => {
    await button(/^Follow a wall/).tap();
    await seen(page.getByRole('region', { name: 'Plan WallFollow, drawn' }));
    await page.getByRole('radio', { name: 'Draw' }).tap();
    // Nothing is wider than the screen: the page is not shrunk to show it.
    assert.equal(await page.evaluate(() => innerWidth), 1024);
    await button('Wait, actor').tap();
    const wait = page.getByRole('group', { name: /^wait, actor Wait/ });
    await seen(wait);
    const seconds = page.getByRole('region', { name: 'Properties' }).getByLabel('seconds');
    await seconds.tap();
    await seconds.pressSequentially('1');
    await press('Enter');
    await wait.getByRole('button', { name: /^Done leads nowhere/ }).tap();
    await page.getByRole('menuitem', { name: 'searchFirstWall', exact: true }).tap();
    await page
      .getByRole('img', { name: 'wait Done leads to searchFirstWall', exact: true })
      .waitFor({ state: 'attached' });
    // Nothing leads to it yet: that is no mistake.
    await seen(button('1 warning'));
    await button('Run').first().tap();
    await seen(button(/Running/));
    await seen(page.locator('.pactive').getByText('searchFirstWall'));
  },
);

test(
  'a plan is made from nothing: named, its actors carried by a finger',
  { width: 1024, height: 768, touch: true },
  async ({ page, button, type }) => {
    await button(/^New/).tap();
    await button('Create').tap();
    await page.getByRole('radio', { name: 'Draw' }).tap();
    // There is none yet: where actors are offered, a plan is, too.
    await button('New plan').tap();
    await focused(page.getByRole('textbox', { name: 'Name of the new file' }));
    await type('Patrol');
    // The name is kept by going elsewhere.
    await page.getByRole('tab', { name: 'Palette' }).tap();
    const canvas = page.getByRole('region', { name: 'Plan Patrol, drawn' });
    await seen(canvas);
    const tool = await boxOf(button('Log, actor'));
    const { x, y, width } = await boxOf(canvas);
    const from = { x: tool.x + 40, y: tool.y + tool.height / 2 };
    const end = { x: x + width / 2, y: y + 60 };
    const between = [1, 2, 3].map((step) => ({
      x: from.x + ((end.x - from.x) * step) / 4,
      y: from.y + ((end.y - from.y) * step) / 4,
    }));
    await swipe(page, [from, ...between, end]);
    const log = page.getByRole('group', { name: /^log, actor Log/ });
    await seen(log);
    const at = await boxOf(log);
    assert.ok(Math.abs(at.x + at.width / 2 - end.x) < 16, 'it is where the finger left it');
  },
);

test(
  'a row of variables shows its name whole, and its buttons inside of the panel',
  { ...tablet, words: ['--example', 'thymio'] },
  async ({ page, layout }) => {
    await layout('Script');
    const list = page.getByRole('list', { name: 'Variables' });
    const name = list.getByText('prox.ground.reflected');
    await seen(name);
    assert.ok(await name.evaluate((one) => one.scrollWidth <= one.clientWidth), 'it is cut off');
    const plot = list.getByRole('button', { name: 'Plot prox.ground.reflected' });
    const { x, width } = await boxOf(plot);
    assert.ok(x + width <= tablet.width, `it ends at ${x + width}`);
  },
);

test(
  'a second tap on a robot opens its menu, which asks why',
  { ...tablet, words: ['--example', 'thymio'] },
  async ({ page, layout, tab }) => {
    await layout('Script');
    await tab('Project').tap();
    const { at, pose } = await openWorld(page, 'arena.world', [2, 1.5]);
    const [x = 0, y = 0] = await pose('thymio');
    const robot = await at(x, y);
    await page.touchscreen.tap(robot.x, robot.y);
    assert.equal(await page.getByRole('menu').count(), 0);
    await page.touchscreen.tap(robot.x, robot.y);
    await seen(page.getByRole('menuitem', { name: 'Why?' }));
  },
);

const landscape = { width: 1024, height: 768, touch: true };

test(
  'a script that waits for a button of the robot is written, tried and taken back with a finger',
  landscape,
  async ({ page, button, editor }) => {
    await button(/^New/).tap();
    await button('Create').tap();
    await seen(editor('thymio-II').getByText('button.forward', { exact: true }));
    await button('Run').first().tap();
    await seen(button(/Running/));
    // Its buttons are offered where the robot is, once it was tapped.
    const world = page.locator('[data-world]');
    const { at, pose } = handsIn(world, [1.6, 1.2]);
    const [x = 0, y = 0] = await pose('thymio');
    const robot = await at(x, y);
    await page.touchscreen.tap(robot.x, robot.y);
    await button('Press forward').tap();
    const row = page.getByRole('list', { name: 'Variables' }).getByRole('listitem');
    await reads(row.filter({ hasText: /^motor\.left\.target/ }), /200/);
    // A keyboard on the screen has no Ctrl+Z.
    const text = editor('thymio-II');
    const first = text.locator('.cm-line').first();
    await first.tap();
    await page.keyboard.insertText('x');
    await reads(first, /x/);
    await button('Undo in this text').tap();
    await reads(first, '# Runs when the program starts.');
    await button('Redo in this text').tap();
    await reads(first, /x/);
  },
);

test(
  'a finger that stays on a button is told what it is, and presses nothing',
  { ...landscape, words: ['--example', 'thymio'] },
  async ({ page, layout, button }) => {
    await layout('Script');
    const bytecode = button('Bytecode beside the text');
    await seen(bytecode);
    await hold(page, bytecode, () =>
      seen(page.getByRole('tooltip', { name: 'Bytecode beside the text' })),
    );
    await button('Upload').tap();
    await gone(page.getByRole('tooltip'));
    assert.equal(await bytecode.getAttribute('aria-pressed'), 'false');
    await bytecode.tap();
    await seen(page.getByRole('button', { name: 'Bytecode beside the text', pressed: true }));
  },
);

test(
  'nothing moves below the bar at the top when a run is paused',
  { ...landscape, words: ['--example', 'follow-wall'] },
  async ({ page, button }) => {
    const bar = page.getByRole('banner');
    await seen(page.getByRole('region', { name: 'Plan WallFollow, drawn' }));
    const height = async () => (await boxOf(bar)).height;
    const ready = await height();
    await button('Run').first().tap();
    await seen(button(/Running/));
    const running = await height();
    await button('Pause').first().tap();
    await seen(button('Continue').first());
    assert.deepEqual([running, await height()], [ready, ready]);
    assert.ok(ready < 60, `it is ${ready} px high`);
  },
);
