// Plots: what is taken out of them.
import assert from 'node:assert/strict';
import { seen, test } from './support/studio.mjs';

test(
  'a plot is copied into the clipboard as a picture with its legend',
  { words: ['--example', 'thymio'] },
  async ({ page, press, button, command }) => {
    await press('F5');
    await button('Plot curve').click({ force: true });
    const drawn = page.locator('.plots canvas').first();
    await drawn.waitFor();
    await command('Copy the plot as PNG');
    await seen(page.getByText('The plot is in the clipboard as PNG.'));
    const picture = await page.evaluate(async () => {
      const [item] = await navigator.clipboard.read();
      const { width, height } = await createImageBitmap(await item.getType('image/png'));
      return { width, height };
    });
    const plot = await drawn.evaluate((one) => {
      const { width, height } = /** @type {HTMLCanvasElement} */ (one);
      return { width, height };
    });
    assert.equal(picture.width, plot.width);
    // One line of 20 pixels with the name of the curve, and 12 around it.
    assert.equal(picture.height, plot.height + 32);
  },
);
