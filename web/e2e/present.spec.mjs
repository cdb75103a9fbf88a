// The layout for a class or a talk: the plan fills its panel, and its names are read from the last row.
import assert from 'node:assert/strict';
import { makeProject } from './support/robots.mjs';
import { boxOf, seen, test, until } from './support/studio.mjs';
/** @import { Page, TestContext } from './support/studio.mjs' */

const kNames = '.pactor__head b, .psup > b, .pstart';

/**
 * How the names are seen, and where the drawing stands in its panel.
 * @param {Page} page
 */
const measured = (page) =>
  page.evaluate((names) => {
    const all = (/** @type {string} */ selector) => [...document.querySelectorAll(selector)];
    const canvas = all('.pcanvas')[0].getBoundingClientRect();
    const zoom = new DOMMatrix(getComputedStyle(all('.react-flow__viewport')[0]).transform).a;
    const inside = (/** @type {DOMRect} */ { left, right, top, bottom }) =>
      left >= canvas.left && right <= canvas.right && top >= canvas.top && bottom <= canvas.bottom;
    const rects = all('.react-flow__node').map((one) => one.getBoundingClientRect());
    const left = Math.min(...rects.map((one) => one.left));
    const right = Math.max(...rects.map((one) => one.right));
    const top = Math.min(...rects.map((one) => one.top));
    const bottom = Math.max(...rects.map((one) => one.bottom));
    // As it is written, not the box around it.
    const written = all(names).map((one) => {
      const range = document.createRange();
      range.selectNodeContents(one);
      return { name: one.textContent, element: one, rect: range.getBoundingClientRect() };
    });
    const meets = (/** @type {DOMRect} */ a, /** @type {DOMRect} */ b) =>
      a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
    return {
      inside: inside(new DOMRect(left, top, right - left, bottom - top)),
      filled: Math.max((right - left) / canvas.width, (bottom - top) / canvas.height),
      least: Math.min(
        ...written.map(({ element }) => parseFloat(getComputedStyle(element).fontSize) * zoom),
      ),
      clipped: written
        .filter(
          ({ element, rect }) =>
            (element.matches('b') && element.scrollWidth > element.clientWidth + 1) ||
            !inside(rect),
        )
        .map(({ name }) => name),
      together: written.flatMap((one, at) =>
        written
          .slice(at + 1)
          .filter((other) => meets(one.rect, other.rect))
          .map((other) => `${one.name} ${other.name}`),
      ),
    };
  }, kNames);

for (const [example, plan] of [
  ['follow-wall', 'WallFollow'],
  ['find-object', 'DriveToObject'],
  ['rooms', 'GoToRoom'],
])
  test(
    `Present shows the whole plan of ${example}, its names large and whole`,
    { words: ['--example', example] },
    async ({ page, layout }) => {
      await layout('Present');
      await seen(page.getByRole('region', { name: `Plan ${plan}, drawn` }));
      // It is at rest: several times in a row.
      let good = 0;
      let last = {};
      await until('it fills its panel, with names of 20 px', async () => {
        const now = await measured(page);
        last = now;
        const isGood =
          now.inside &&
          now.filled > 0.85 &&
          now.least >= 19.9 &&
          now.clipped.length + now.together.length === 0;
        good = isGood ? good + 1 : 0;
        return good > 12;
      }).catch((error) => {
        error.message += JSON.stringify(last);
        throw error;
      });
      assert.equal(await page.getByText('Nothing plotted.').count(), 0);
    },
  );

const wait = (/** @type {string} */ to, seconds = 1000) => ({
  template: 'Wait',
  in: { seconds },
  states: { Done: to },
});

test(
  'of a plan too large to be read Present shows where it is',
  {
    prepare: (/** @type {TestContext} */ t) =>
      makeProject(
        t,
        { name: 'L', plan: 'P.plan.json', world: 'room.world.json', target: 'sim' },
        {
          'room.world.json': JSON.stringify({ format: 'vagus-world/1', size: [2, 2] }),
          'P.plan.json': JSON.stringify({
            format: 'vagus-plan/1',
            name: 'P',
            start: { actor: 'near' },
            actors: { near: wait('far', 0.1), far: wait('near') },
            layout: { near: [0, 0], far: [9000, 3000] },
          }),
        },
      ),
  },
  async ({ page, layout, press }) => {
    await layout('Present');
    await seen(page.getByRole('region', { name: 'Plan P, drawn' }));
    await press('F5');
    const far = page.locator('.pactor.is-active').filter({ hasText: 'far' });
    await seen(far);
    await until('the active actor is in sight, and can be read', async () => {
      const { least } = await measured(page);
      const { x, y, width, height } = await boxOf(far);
      const canvas = await boxOf(page.locator('.pcanvas'));
      return (
        least >= 19.9 &&
        x >= canvas.x &&
        y >= canvas.y &&
        x + width <= canvas.x + canvas.width &&
        y + height <= canvas.y + canvas.height
      );
    });
  },
);

test(
  'without a world Present has no empty panel',
  {
    prepare: (/** @type {TestContext} */ t) =>
      makeProject(
        t,
        { name: 'L', plan: 'P.plan.json' },
        { 'P.plan.json': '{ "format": "vagus-plan/1", "name": "P", "actors": {} }' },
      ),
  },
  async ({ page, layout }) => {
    await layout('Present');
    await seen(page.getByRole('region', { name: 'Plan P, drawn' }));
    assert.equal(await page.getByText('No world', { exact: true }).count(), 0);
    assert.ok((await boxOf(page.locator('.pcanvas'))).width > 1400);
  },
);

test(
  'a window of 720 x 450 has its whole top bar in sight',
  { words: ['--example', 'follow-wall'], width: 720, height: 450 },
  async ({ page, layout }) => {
    await layout('Draw');
    await seen(page.getByRole('button', { name: /^Target/ }));
    const cut = await page.evaluate(() =>
      [...document.querySelectorAll('.topbar button')]
        .filter((one) => one.checkVisibility())
        .filter((one) => {
          const { left, right, bottom } = one.getBoundingClientRect();
          return left < 0 || right > innerWidth || bottom > innerHeight;
        })
        .map((one) => one.textContent || one.getAttribute('aria-label')),
    );
    assert.deepEqual(cut, []);
  },
);
