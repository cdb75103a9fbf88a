// The image on the ground of a world, from above and in 3D; and what drawing in 3D leaves behind.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { deflateSync, crc32 } from 'node:zlib';
import { makeProject } from './support/robots.mjs';
import { seen, test, until } from './support/studio.mjs';
import { openWorld } from './support/world.mjs';
/** @import { TestContext } from './support/studio.mjs' */

/**
 * A PNG of two pixels side by side.
 * @param {[number, number, number]} left
 * @param {[number, number, number]} right
 */
function png(left, right, note = '') {
  const chunk = (/** @type {string} */ kind, /** @type {Buffer} */ content) => {
    const body = Buffer.concat([Buffer.from(kind), content]);
    const [size, sum] = [Buffer.alloc(4), Buffer.alloc(4)];
    size.writeUInt32BE(content.length);
    sum.writeUInt32BE(crc32(body));
    return Buffer.concat([size, body, sum]);
  };
  const head = Buffer.from([0, 0, 0, 2, 0, 0, 0, 1, 8, 2, 0, 0, 0]);
  return Buffer.concat([
    Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]),
    chunk('IHDR', head),
    chunk('tEXt', Buffer.from(`Comment\0${note}`)),
    chunk('IDAT', deflateSync(Buffer.from([0, ...left, ...right]))),
    chunk('IEND', Buffer.alloc(0)),
  ]);
}

/** @type {[number, number, number]} */ const kRed = [220, 30, 30];
/** @type {[number, number, number]} */ const kBlue = [30, 30, 220];
const kRoom = {
  format: 'vagus-world/1',
  name: 'Room',
  size: [2, 1],
  ground: { image: 'floor.png' },
  robots: [{ name: 'alice', type: 'thymio2', at: [1, 0.5], node: 1 }],
};
const prepare = (/** @type {TestContext} */ t) => {
  const made = makeProject(
    t,
    { name: 'Ground', world: 'room.world.json', target: 'sim' },
    { 'room.world.json': JSON.stringify(kRoom, null, 2) },
  );
  writeFileSync(join(made.place, 'floor.png'), png(kRed, kBlue));
  return made;
};
const isRed = (/** @type {readonly number[]} */ [r = 0, , b = 0]) => r > 2 * b;
const isBlue = (/** @type {readonly number[]} */ [r = 0, , b = 0]) => b > 2 * r;

test(
  'an image lies on the ground, in 3D too, and is drawn again when it is another one',
  { prepare },
  async (studio) => {
    const { page, place } = studio;
    const world = await openWorld(page, 'room.world', [2, 1]);
    const { view, colour } = world;
    const shows = (
      /** @type {(one: number[]) => boolean} */ left,
      /** @type {(one: number[]) => boolean} */ right,
    ) =>
      until(
        'the image on the ground',
        async () => left(await colour(0.3, 0.83)) && right(await colour(1.7, 0.83)),
      );
    await shows(isRed, isBlue);
    await view.getByRole('radio', { name: 'Live' }).click();
    await seen(view.getByRole('button', { name: 'Add' }));
    await shows(isRed, isBlue);
    // Another image in the same file: the world that has not begun has it, and both views show it.
    writeFileSync(join(place, 'floor.png'), png(kBlue, kRed, 'the other way round'));
    await shows(isBlue, isRed);
    await view.getByRole('radio', { name: 'Edit' }).click();
    await shows(isBlue, isRed);
    // In 3D the left half is the left half.
    await view.getByRole('button', { name: 'In 3D' }).click();
    await seen(view.getByRole('button', { name: 'From above' }));
    const half = async (/** @type {number} */ part) => {
      const canvas = view.locator('.world__solid canvas');
      if ((await canvas.count()) === 0) return [];
      const image = (await canvas.screenshot()).toString('base64');
      return page.evaluate(async ([base64, share]) => {
        const bytes = Uint8Array.from(atob(String(base64)), (letter) => letter.charCodeAt(0));
        const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
        const paper = new OffscreenCanvas(bitmap.width, bitmap.height);
        const pen = paper.getContext('2d');
        pen?.drawImage(bitmap, 0, 0);
        const pixel = pen?.getImageData(bitmap.width * Number(share), bitmap.height / 2, 1, 1).data;
        return [...(pixel ?? [])];
      }, /** @type {[string, number]} */ ([image, part]));
    };
    await until('in 3D', async () => isBlue(await half(0.35)) && isRed(await half(0.65)));
  },
);

test('twenty changes of layout leave no WebGL context behind', { prepare }, async (studio) => {
  const { page, layout } = studio;
  await page.addInitScript(() => {
    const made = /** @type {WebGL2RenderingContext[]} */ ([]);
    Object.assign(window, { made });
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = /** @type {typeof get} */ (
      /** @this {HTMLCanvasElement} @param {[string, ...unknown[]]} words */
      function (...words) {
        const context = Reflect.apply(get, this, words);
        if (context instanceof WebGL2RenderingContext && !made.includes(context))
          made.push(context);
        return context;
      }
    );
  });
  await page.reload();
  await layout('Present');
  await page.getByRole('button', { name: 'In 3D' }).first().click();
  await seen(page.locator('.world__solid canvas'));
  const contexts = () =>
    page.evaluate(() => {
      const { made } = /** @type {{ made: WebGL2RenderingContext[] }} */ (
        /** @type {unknown} */ (window)
      );
      return { all: made.length, alive: made.filter((one) => !one.isContextLost()).length };
    });
  const shown = () => page.locator('.world__solid canvas').count();
  for (let turn = 0; turn < 10; turn++)
    for (const name of ['Script', 'Present']) {
      await layout(name);
      await until(
        'the world of that layout',
        async () => name !== 'Present' || (await shown()) > 0,
      );
    }
  await until('only what is shown is alive', async () => {
    const { all, alive } = await contexts();
    return all > 2 && alive === (await shown());
  });
  const { alive } = await contexts();
  assert.ok(alive <= 2, `${alive} contexts`);
});
