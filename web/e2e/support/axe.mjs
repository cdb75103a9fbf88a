// What axe finds serious on a page.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';

const source = readFileSync(
  new URL('../../node_modules/axe-core/axe.min.js', import.meta.url),
  'utf8',
);

/**
 * @param {{ page: import('playwright-core').Page }} studio
 * @param {string} view
 */
export async function look({ page }, view) {
  // The page's policy lets no script in from elsewhere: it is put there by the browser's own hand.
  const found = await page.evaluate(
    `${source}; axe.run(document, { resultTypes: ['violations'] }).then(({ violations }) =>
      violations.filter(({ impact }) => impact === 'serious' || impact === 'critical')
        .map(({ id, nodes }) => id + ': ' + nodes.slice(0, 3).map((node) => node.html.slice(0, 200)).join(' | ')))`,
  );
  assert.deepEqual(found, [], view);
}
