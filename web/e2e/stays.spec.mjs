// A drawing stays where it is: nothing moves on the screen that was not touched.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { isDeepStrictEqual } from 'node:util';
import { makeProject } from './support/robots.mjs';
import { runTo } from './support/runs.mjs';
import { boxOf, gone, openWindow, seen, test, until } from './support/studio.mjs';
/** @import { Page, Studio, TestContext } from './support/studio.mjs' */

const actor = (/** @type {string} */ to) => ({
  template: 'Wait',
  in: { seconds: 1 },
  states: { Done: to },
});
const plan = (/** @type {string} */ name, more = {}) => ({
  format: 'vagus-plan/1',
  name,
  configuration: { x: { type: 'int', initial: 1 } },
  start: { actor: 'one' },
  actors: { one: actor('two'), two: actor('@terminate'), ...more },
});
const files = {
  'P.plan.json': JSON.stringify(
    plan('P', { sub: { plan: 'S.plan.json', states: { OK: '@terminate' } } }),
  ),
  'S.plan.json': JSON.stringify(plan('S')),
};
const project = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(t, { name: 'P', plan: 'P.plan.json' }, files),
};

/** Without a mistake. */
const sound = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(
      t,
      { name: 'P', plan: 'P.plan.json' },
      { 'P.plan.json': JSON.stringify(plan('P')) },
    ),
};

/** Where each element is on the screen, in whole pixels; nothing of hidden tabs. */
const places = (/** @type {Page} */ page) =>
  page.evaluate(() =>
    Object.fromEntries(
      [...document.querySelectorAll('.react-flow__node')]
        .filter((node) => node.checkVisibility())
        .map((node) => {
          const { x, y } = node.getBoundingClientRect();
          return [node.getAttribute('data-id'), `${Math.round(x)} ${Math.round(y)}`];
        }),
    ),
  );

async function settled(/** @type {Page} */ page) {
  let last = '';
  await until('the drawing has come to rest', async () => {
    const now = JSON.stringify(await places(page));
    const rests = now === last && now !== '{}';
    last = now;
    return rests;
  });
  return JSON.parse(last);
}

test('dropping, a line above it and deleting move nothing else', project, async (studio) => {
  const { page, press, layout } = studio;
  await layout('Draw');
  await seen(page.getByRole('region', { name: 'Plan P, drawn' }));
  const before = await settled(page);
  const canvas = await boxOf(page.locator('.pcanvas'));
  // Far from the others; its state leads nowhere, which is an error and a line above the drawing.
  await page
    .getByRole('button', { name: 'Wait, actor' })
    .dragTo(page.locator('.pcanvas'), { targetPosition: { x: canvas.width - 120, y: 60 } });
  await seen(page.getByRole('group', { name: /^wait, actor Wait, 2 errors/ }));
  const { wait, ...others } = await settled(page);
  assert.ok(wait);
  assert.deepEqual(others, before);
  await press('Delete');
  await page.getByRole('group', { name: /^wait, actor/ }).waitFor({ state: 'detached' });
  assert.deepEqual(await settled(page), before);
});

test(
  'each canvas has its own arrowheads, also the second tab',
  project,
  async ({ page, layout }) => {
    await layout('Draw');
    await page.getByRole('tab', { name: /^Project/ }).click();
    await page.locator('[role="treeitem"][data-path="S.plan.json"]').click();
    await seen(page.getByRole('region', { name: 'Plan S, drawn' }));
    await page.locator('.parrow__line').last().waitFor({ state: 'attached' });
    const { ids, foreign } = await page.evaluate(() => ({
      ids: [...document.querySelectorAll('marker')].map((one) => one.id),
      foreign: [...document.querySelectorAll('.parrow__line')].filter((line) => {
        const id = /url\("?#([^")]+)"?\)/.exec(line.getAttribute('marker-end') ?? '')?.[1];
        return !line.closest('svg')?.contains(document.getElementById(id ?? ''));
      }).length,
    }));
    assert.equal(new Set(ids).size, ids.length, ids.join(' '));
    assert.equal(foreign, 0);
  },
);

test(
  'a sub-plan that is opened is the one that forms and keys are for',
  project,
  async (studio) => {
    const { page, press, layout } = studio;
    await layout('Draw');
    await page.getByRole('group', { name: /^sub, sub-plan/ }).focus();
    await press('Space', 'o');
    await seen(page.getByRole('region', { name: 'Plan S, drawn' }));
    await until('the drawing has the focus', () =>
      page.evaluate(() => document.activeElement?.getAttribute('aria-label') === 'Plan S, drawn'),
    );
    await press('Control+a');
    await seen(page.getByRole('heading', { name: 'two' }));
    await page.getByRole('heading', { name: 'sub', exact: true }).waitFor({ state: 'detached' });
  },
);

test(
  'zoom is told in per cent; the map covers no element',
  { words: ['--example', 'follow-wall'] },
  async (studio) => {
    const { page, press, layout, button } = studio;
    await layout('Draw');
    await seen(page.getByRole('region', { name: 'Plan WallFollow, drawn' }));
    await settled(page);
    await button(/^Zoom: \d+ %$/).click();
    await seen(button('Zoom: 100 %'));
    for (const key of ['+', '-', '-', '-']) {
      await page.locator('.pcanvas').focus();
      await press(key);
      await settled(page);
      const covered = await page.evaluate(() => {
        const map = document.querySelector('.react-flow__minimap')?.getBoundingClientRect();
        return [...document.querySelectorAll('.react-flow__node')].filter((node) => {
          const { left, right, top, bottom } = node.getBoundingClientRect();
          return (
            map && left < map.right && right > map.left && top < map.bottom && bottom > map.top
          );
        }).length;
      });
      assert.equal(covered, 0);
    }
  },
);

/** What is seen of the plan: where its first actor stands in the panel, and how large. */
const view = (/** @type {Page} */ page) =>
  page.evaluate(() => {
    const actor = [...document.querySelectorAll('[data-id="one"]')].find((one) =>
      one.checkVisibility(),
    );
    const panel = actor?.closest('[data-tab-content]');
    if (!actor || !panel) return '';
    const { x, y, width } = actor.getBoundingClientRect();
    const { left, top } = panel.getBoundingClientRect();
    return [x - left, y - top, width].map(Math.round).join(' ');
  });

async function viewed(/** @type {Page} */ page) {
  await settled(page);
  return view(page);
}

/** Somewhere else, at another zoom: by hand. */
async function lookElsewhere(/** @type {Studio} */ { page, press }) {
  const canvas = await boxOf(page.locator('.pcanvas'));
  await page.mouse.move(canvas.x + 40, canvas.y + canvas.height - 30);
  await page.mouse.down();
  await page.mouse.move(canvas.x + 107, canvas.y + canvas.height - 83, { steps: 3 });
  await page.mouse.up();
  await press('+');
  return viewed(page);
}

test(
  'layouts, other tabs and a reload show the place that was looked at',
  project,
  async (studio) => {
    const { page, layout, tab } = studio;
    await layout('Draw');
    const plan = page.getByRole('region', { name: 'Plan P, drawn' });
    await seen(plan);
    const fitted = await viewed(page);
    const mine = await lookElsewhere(studio);
    assert.notEqual(mine, fitted);
    for (const name of ['Debug', 'Draw', 'Present', 'Debug', 'Draw']) {
      await layout(name);
      await seen(page.getByRole('radio', { name, checked: true }));
      await seen(plan);
      if (name === 'Present') continue;
      await until(`${name} shows the same place`, async () => (await viewed(page)) === mine);
    }
    await tab(/^Project/).click();
    await page.locator('[role="treeitem"][data-path="S.plan.json"]').click();
    await seen(page.getByRole('region', { name: 'Plan S, drawn' }));
    await tab(/^P\.plan/).click();
    await seen(plan);
    assert.equal(await viewed(page), mine);
    await page.reload();
    await seen(plan);
    await until('a reload shows the same place', async () => (await viewed(page)) === mine);
  },
);

test(
  'a plan that is paused stays at its place over a reload, too',
  { words: ['--example', 'follow-wall'] },
  async (studio) => {
    const { page } = studio;
    await runTo(studio, 'findWallAngle');
    await lookElsewhere(studio);
    const mine = await settled(page);
    await page.reload();
    await seen(page.getByText('Paused by the breakpoint findWallAngle'));
    await until('a reload shows the same place', async () =>
      isDeepStrictEqual(await settled(page), mine),
    );
  },
);

test('what is seen is each window\u2019s own', project, async (studio, t) => {
  const { page, layout, server } = studio;
  const other = await openWindow(t, server);
  await layout('Draw');
  await other.layout('Draw');
  await seen(other.page.getByRole('region', { name: 'Plan P, drawn' }));
  const fitted = await viewed(other.page);
  await lookElsewhere(studio);
  await other.layout('Debug');
  await other.layout('Draw');
  await seen(other.page.getByRole('region', { name: 'Plan P, drawn' }));
  assert.equal(await viewed(other.page), fitted);
  assert.deepEqual(other.complaints, []);
  await seen(page.getByRole('region', { name: 'Plan P, drawn' }));
});

for (const by of ['the button', 'the palette'])
  test(`after ${by} has zoomed a line above the drawing moves nothing`, sound, async (studio) => {
    const { page, layout, button, command, place } = studio;
    await layout('Draw');
    await seen(page.getByRole('region', { name: 'Plan P, drawn' }));
    await settled(page);
    if (by === 'the button') await button(/^Zoom: \d+ %$/).click();
    else await command('Plan: zoom in');
    const before = await settled(page);
    // An actor without a value is an error, and a line above the drawing.
    const file = join(place, 'P.plan.json');
    const good = readFileSync(file, 'utf8');
    writeFileSync(file, good.replace('"in":{"seconds":1}', '"in":{}'));
    const line = page.locator('.plan .notice--error');
    await seen(line);
    assert.deepEqual(await settled(page), before);
    writeFileSync(file, good);
    await gone(line);
    assert.deepEqual(await settled(page), before);
  });

test('Tidy brings the whole plan in sight', project, async (studio) => {
  const { page, press, layout } = studio;
  await layout('Draw');
  await seen(page.getByRole('region', { name: 'Plan P, drawn' }));
  await settled(page);
  const canvas = await boxOf(page.locator('.pcanvas'));
  await page.mouse.move(canvas.x + 40, canvas.y + canvas.height - 30);
  await page.mouse.down();
  await page.mouse.move(canvas.x + canvas.width + 900, canvas.y - 700, { steps: 3 });
  await page.mouse.up();
  await page.locator('.pcanvas').focus();
  await press('t');
  await until('all of it is in sight', () =>
    page.evaluate(() => {
      const frame = document.querySelector('.pcanvas')?.getBoundingClientRect();
      return [...document.querySelectorAll('.react-flow__node')].every((node) => {
        const { left, right, top, bottom } = node.getBoundingClientRect();
        return (
          frame !== undefined &&
          left >= frame.left &&
          right <= frame.right &&
          top >= frame.top &&
          bottom <= frame.bottom
        );
      });
    }),
  );
});

test('what a press on the palette adds is put where it is seen', project, async (studio) => {
  const { page, button, layout } = studio;
  await layout('Draw');
  await seen(page.getByRole('region', { name: 'Plan P, drawn' }));
  // Problems opens at the first error and leaves less room for the drawing.
  await seen(page.getByText(/"Interrupted" of "sub" leads nowhere/).last());
  const before = await settled(page);
  // Below each other they would leave the window at the second.
  for (const name of ['wait', 'wait2', 'wait3']) {
    await button('Wait, actor').click();
    await seen(page.getByRole('group', { name: new RegExp(`^${name}, actor Wait`) }));
    await settled(page);
  }
  const { wait, wait2, wait3, ...others } = await settled(page);
  assert.ok(wait && wait2 && wait3);
  assert.deepEqual(others, before);
});

test('a click on one of several chosen elements chooses it alone', sound, async (studio) => {
  const { page, press, layout } = studio;
  await layout('Draw');
  const one = page.getByRole('group', { name: /^one, actor/ });
  await one.click();
  await press('Control+a');
  await seen(page.getByText('2 elements are selected.'));
  const chosen = page.locator('.react-flow__node.selected');
  assert.equal(await chosen.count(), 2);
  await one.click();
  await until('one is chosen', async () => (await chosen.count()) === 1);
  await seen(page.getByRole('heading', { name: 'one', exact: true }));
  // A key beside the click adds, as before.
  await page.getByRole('group', { name: /^two, actor/ }).click({ modifiers: ['Control'] });
  await until('both are chosen', async () => (await chosen.count()) === 2);
});

for (const [place, selector] of [
  ['form', '[aria-label="Properties"] button'],
  ['palette', '.palettepanel button'],
  ['bar', '.plan__bar button:enabled'],
])
  test(`Ctrl+Z takes back a step of the plan from the ${place}, too`, sound, async (studio) => {
    const { page, press, button, layout } = studio;
    await layout('Draw');
    await seen(page.getByRole('group', { name: /^one, actor/ }));
    await button('Wait, actor').click();
    const wait = page.getByRole('group', { name: /^wait, actor/ });
    await seen(wait);
    await page
      .locator(selector ?? '')
      .first()
      .focus();
    await press('Control+z');
    await gone(wait);
  });
