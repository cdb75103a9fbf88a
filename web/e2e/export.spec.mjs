// The drawing of a plan as a file that other programs open.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { root } from './support/server.mjs';
import { seen, test } from './support/studio.mjs';
/** @import { Page, Studio } from './support/studio.mjs' */

const wall = { words: ['--example', 'follow-wall'] };
const plan = JSON.parse(
  readFileSync(join(root, 'examples/follow-wall/WallFollow.plan.json'), 'utf8'),
);

async function drawn(/** @type {Studio} */ { page, layout }) {
  await layout('Draw');
  await seen(page.getByRole('group', { name: 'followWall, actor WallForward', exact: false }));
}

async function downloaded(/** @type {Page} */ page, /** @type {() => unknown} */ act) {
  const [file] = await Promise.all([page.waitForEvent('download'), act()]);
  return { name: file.suggestedFilename(), bytes: readFileSync(await file.path()) };
}

/** What a browser sees in it. */
const parsed = (/** @type {Page} */ page, /** @type {string} */ svg) =>
  page.evaluate((/** @type {string} */ text) => {
    const all = new DOMParser().parseFromString(text, 'image/svg+xml');
    return {
      isBroken: all.querySelector('parsererror') !== null,
      texts: [...all.querySelectorAll('text')].map((one) => one.textContent),
      width: Number(all.documentElement.getAttribute('width')),
      height: Number(all.documentElement.getAttribute('height')),
      frame: all.querySelector('rect')?.getAttribute('fill'),
    };
  }, svg);

test('events are saved as CSV where nobody has looked at them', wall, async (studio) => {
  const { page, press, command } = studio;
  await drawn(studio);
  await press('F5');
  await seen(page.getByRole('button', { name: /Running/ }));
  const csv = await downloaded(page, () => command('Save the events as CSV'));
  assert.equal(csv.name, 'events.csv');
  const [head, ...rows] = csv.bytes.toString().trim().split('\r\n');
  assert.equal(head, 'run,time,wall,kind,node,source,name,text,args');
  assert.ok(
    rows.some((row) => row.split(',')[3] === 'appeared'),
    rows.join(),
  );
});

test('the whole plan is exported as SVG, in the colours of the theme', wall, async (studio) => {
  const { page, button, command } = studio;
  await drawn(studio);
  const dark = await downloaded(page, () => command('Plan: export as SVG'));
  assert.equal(dark.name, 'WallFollow.svg');
  const seenIn = await parsed(page, dark.bytes.toString('utf8'));
  assert.equal(seenIn.isBroken, false);
  for (const name of Object.keys(plan.actors)) assert.ok(seenIn.texts.includes(name), name);
  assert.ok(seenIn.texts.includes('Start') && seenIn.texts.includes('LaneNotFree'));
  // From the first place of the layout to the last, at least.
  const xs = Object.keys(plan.actors).map((name) => plan.layout[name][0]);
  assert.ok(seenIn.width > Math.max(...xs) - Math.min(...xs), `${seenIn.width} px wide`);
  assert.equal(seenIn.frame, '#101216');
  await page.emulateMedia({ colorScheme: 'light' });
  const light = await downloaded(page, async () => {
    await button('Export the drawing').click();
    await page.getByRole('menuitem', { name: 'As SVG' }).click();
  });
  assert.equal((await parsed(page, light.bytes.toString('utf8'))).frame, '#f5f6f8');
});

test('a PNG decodes and has twice the size of the SVG', wall, async (studio) => {
  const { page, command } = studio;
  await drawn(studio);
  const svg = await downloaded(page, () => command('Plan: export as SVG'));
  const png = await downloaded(page, () => command('Plan: export as PNG'));
  assert.equal(png.name, 'WallFollow.png');
  const { width, height } = await parsed(page, svg.bytes.toString('utf8'));
  const seenIn = await page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const canvas = new OffscreenCanvas(image.width, image.height);
    const to = canvas.getContext('2d');
    if (!to) throw new Error('nothing to draw on');
    to.drawImage(image, 0, 0);
    const { data } = to.getImageData(0, 0, image.width, image.height);
    const colours = new Set();
    for (let at = 0; at < data.length; at += 4)
      colours.add((data[at] << 16) | (data[at + 1] << 8) | data[at + 2]);
    return { width: image.width, height: image.height, colours: colours.size };
  }, png.bytes.toString('base64'));
  assert.deepEqual([seenIn.width, seenIn.height], [2 * width, 2 * height]);
  // Boxes, arrows, names: no empty sheet.
  assert.ok(seenIn.colours > 20, `${seenIn.colours} colours`);
});
