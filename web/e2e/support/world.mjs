// The picture of a world as a hand sees it: where on the screen things stand, and what is drawn there.
import { boxOf, until } from './studio.mjs';
/** @import { Page, Locator } from './studio.mjs' */

/** As core/world/view.ts fits a world into its picture. */
const kWall = 0.06;
const kMargin = 10;

/** @param {string} text */
const number = (text) => Number(text.replace('−', '-').replace('°', ''));

/**
 * The document of a world, opened from the list of files.
 * @param {Page} page
 * @param {string} file
 * @param {[number, number]} size
 */
export async function openWorld(page, file, size) {
  await page.getByRole('treeitem', { name: file }).dblclick();
  const view = page
    .locator('[data-world]')
    .filter({ has: page.getByRole('radio', { name: 'Live' }) });
  await view.waitFor();
  return { view, ...handsIn(view, size) };
}

/**
 * @param {Locator} view
 * @param {[number, number]} size metres
 */
export function handsIn(view, [width, height]) {
  /**
   * A place of the world, on the screen.
   * @param {number} x
   * @param {number} y
   */
  const at = async (x, y) => {
    const box = await boxOf(view.locator('canvas').first());
    const scale = Math.min(
      (box.width - 2 * kMargin) / (width + 2 * kWall),
      (box.height - 2 * kMargin) / (height + 2 * kWall),
    );
    return {
      x: box.x + box.width / 2 + (x - width / 2) * scale,
      y: box.y + box.height / 2 - (y - height / 2) * scale,
    };
  };
  /** @param {string} name */
  const placeIn = async (name) => {
    const row = view.getByRole('table', { name: 'Things' }).getByRole('row', { name });
    return (await row.getByRole('cell').allInnerTexts()).map(number);
  };
  return {
    at,
    /**
     * Place and angle of a thing, once they are known.
     * @param {string} name
     */
    pose: (name) =>
      until(`the place of ${name}`, async () => {
        const found = await placeIn(name);
        return found.length === 3 && found.every(Number.isFinite) && found;
      }),
    /**
     * Until a thing stands there.
     * @param {string} name
     * @param {number} x
     * @param {number} y
     */
    stands: (name, x, y, within = 0.011) =>
      until(`${name} stands at ${x}, ${y}`, async () => {
        const [a = NaN, b = NaN] = await placeIn(name);
        return Math.abs(a - x) < within && Math.abs(b - y) < within;
      }),
    names: async () => {
      const rows = view.getByRole('table', { name: 'Things' }).getByRole('rowheader');
      return (await rows.allInnerTexts()).map((one) => one.trim());
    },
    /**
     * What is drawn at a place: red, green, blue of the picture from above.
     * @param {number} x
     * @param {number} y
     */
    colour: async (x, y) => {
      const canvas = view.locator('canvas').first();
      const box = await boxOf(canvas);
      const place = await at(x, y);
      return canvas.evaluate(
        (one, [left, top]) => {
          if (!(one instanceof HTMLCanvasElement)) return [];
          const ratio = one.width / one.clientWidth;
          // Read from a copy: the browser complains of a canvas that is read often.
          const pen = new OffscreenCanvas(1, 1).getContext('2d');
          pen?.drawImage(one, -Math.round(left * ratio), -Math.round(top * ratio));
          const pixel = pen?.getImageData(0, 0, 1, 1).data;
          return [...(pixel ?? [])].slice(0, 3);
        },
        /** @type {[number, number]} */ ([place.x - box.x, place.y - box.y]),
      );
    },
  };
}
