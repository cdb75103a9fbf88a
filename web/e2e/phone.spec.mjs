// The page on a telephone: good enough to watch, to stop and to start.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { twoNodes } from './support/robots.mjs';
import { boxOf, gone, reads, seen, test, until } from './support/studio.mjs';
/** @import { Page, Studio, TestContext } from './support/studio.mjs' */

const source = readFileSync(
  new URL('../node_modules/axe-core/axe.min.js', import.meta.url),
  'utf8',
);
const phone = { width: 390, height: 844, touch: true, words: ['--example', 'follow-wall'] };
const kThumb = 44;

async function serious(/** @type {Page} */ page) {
  return page.evaluate(
    `${source}; axe.run(document, { resultTypes: ['violations'] }).then(({ violations }) =>
      violations.filter(({ impact }) => impact === 'serious' || impact === 'critical')
        .map(({ id, nodes }) => id + ': ' + nodes.slice(0, 3).map((node) => node.html.slice(0, 200)).join(' | ')))`,
  );
}

const controls = (/** @type {Page} */ page) => page.getByRole('group', { name: 'Run controls' });

/** Nothing is wider than the screen, and Stop is on it, as large as a thumb. */
async function fits(/** @type {Studio} */ { page }, /** @type {string} */ view) {
  const bar = controls(page);
  const [wide, screen] = await page.evaluate(() => [
    Math.max(document.documentElement.scrollWidth, document.body.scrollWidth),
    innerWidth,
  ]);
  assert.ok(wide <= screen, `${view}: ${wide} px wide on a screen of ${screen}`);
  for (const name of [/^Stop$/, /^(Run|Running|Continue)$/, /^Pause$/]) {
    const box = await boxOf(bar.getByRole('button', { name }));
    assert.ok(box.height >= kThumb && box.width >= kThumb, `${view}: ${name} is ${box.height} px`);
    assert.ok(box.x >= 0 && box.x + box.width <= screen && box.y >= 0 && box.y < 844, view);
  }
  for (const tab of await page.getByRole('tab').all())
    assert.ok((await boxOf(tab)).height >= kThumb, view);
}

for (const theme of /** @type {const} */ (['dark', 'light']))
  test(`watch, start, pause and stop by touch, ${theme}`, { ...phone, theme }, async (studio) => {
    const { page, tab } = studio;
    const button = (/** @type {string} */ name) =>
      controls(page).getByRole('button', { name, exact: true });
    await seen(tab('Plan'));
    await fits(studio, 'before the run');
    await button('Run').tap();
    await seen(button('Running'));
    await seen(page.getByText('searchFirstWall').first());
    await reads(page.locator('.phone__clock'), /^Running · \d+\.\d s$/);
    await fits(studio, 'plan');
    assert.deepEqual(await serious(page), [], 'plan');
    await keep(page, `plan-${theme}`);
    for (const { name, shown } of [
      { name: 'World', shown: page.locator('[data-world]') },
      { name: 'Variables', shown: page.getByRole('searchbox', { name: 'Find in all nodes' }) },
      { name: 'Console', shown: page.getByRole('tabpanel', { name: 'Console' }) },
    ]) {
      await tab(name).tap();
      await seen(shown);
      await fits(studio, name);
      assert.deepEqual(await serious(page), [], name);
      await keep(page, `${name}-${theme}`);
    }
    await button('Pause').tap();
    await seen(button('Continue'));
    await button('Continue').tap();
    await seen(button('Running'));
    await button('Stop').tap();
    await seen(button('Run'));
    await reads(page.locator('.phone__clock'), /^Stopped · /);
  });

test('who only looks can stop', phone, async (studio) => {
  const { page, button, context, server } = studio;
  await button('Run').tap();
  await seen(button('Running'));
  const other = await context.newPage();
  await other.goto(server.address);
  await seen(other.getByText(/View only/));
  assert.ok(await other.getByRole('button', { name: 'Running' }).isDisabled());
  await other.getByRole('button', { name: 'Stop', exact: true }).tap();
  await seen(button('Run'));
  await seen(page.getByText(/Stopped/));
});

test(
  'without a plan the nodes that run on a bus are named',
  {
    ...phone,
    words: [],
    prepare: (/** @type {TestContext} */ t) =>
      twoNodes(t, { left: 'var a = 0\n', right: 'var b = 0\n' }),
  },
  async ({ page }) => {
    await reads(page.locator('.phone__clock'), 'Running: left, right');
  },
);

test('a wide window is the studio, a narrow one a telephone', phone, async ({ page, tab }) => {
  await seen(tab('Plan'));
  await page.setViewportSize({ width: 1200, height: 800 });
  await seen(page.getByRole('radio', { name: 'Script' }));
  await page.setViewportSize({ width: 390, height: 844 });
  await gone(page.getByRole('radio', { name: 'Script' }));
  await seen(tab('World'));
  await until(
    'the plan is shown',
    async () => (await tab('Plan').getAttribute('aria-selected')) === 'true',
  );
});

/** For who wants to look: VAGUS_LOOK names a folder. */
async function keep(/** @type {Page} */ page, /** @type {string} */ name) {
  if (process.env.VAGUS_LOOK)
    await page.screenshot({ path: `${process.env.VAGUS_LOOK}/${name}.png` });
}
