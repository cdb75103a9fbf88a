// What axe finds serious on a page.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';

const source = readFileSync(
  new URL('../../node_modules/axe-core/axe.min.js', import.meta.url),
  'utf8',
);

/**
 * The whole page, or only what `within` holds: what a panel is beside is the same as before it was shown, and looking
 * at everything again takes a second or two.
 * @param {{ page: import('playwright-core').Page }} studio
 * @param {string} view
 * @param {import('playwright-core').Locator} [within]
 */
export async function look({ page }, view, within = page.locator('html')) {
  // The page's policy lets no script in from elsewhere: it is put there by the browser's own hand.
  if (!(await page.evaluate('"axe" in window'))) await page.evaluate(source);
  const found = await within.evaluate(async (element) => {
    const { axe } = /** @type {{ axe: typeof import('axe-core') }} */ (/** @type {any} */ (window));
    const { violations } = await axe.run(element, { resultTypes: ['violations'] });
    return violations
      .filter(({ impact }) => impact === 'serious' || impact === 'critical')
      .map(({ id, nodes }) => {
        const some = nodes.slice(0, 3).map((node) => node.html.slice(0, 200));
        return `${id}: ${some.join(' | ')}`;
      });
  });
  assert.deepEqual(found, [], view);
}
