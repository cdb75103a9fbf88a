// The world: seen, touched, edited.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { seen, test, until } from './support/studio.mjs';
import { openWorld } from './support/world.mjs';
/** @import { Page } from './support/studio.mjs' */

const thymio = { words: ['--example', 'thymio'] };
const number = (/** @type {string} */ text) => Number(text.replace('−', '-').replace('°', ''));

/** Place and angle of a thing, once they are known. */
async function pose(/** @type {Page} */ page, /** @type {string} */ name) {
  return until(`the place of ${name}`, async () => {
    const found = await placeIn(page, name);
    return found.length === 3 && found.every(Number.isFinite) && found;
  });
}

async function placeIn(/** @type {Page} */ page, /** @type {string} */ name) {
  const row = page.getByRole('table', { name: 'Things' }).first().getByRole('row', { name });
  return (await row.getByRole('cell').allInnerTexts()).map(number);
}

test('a robot drives in it; hands move, press, put down', thymio, async (studio) => {
  const { page, press, button, command, layout } = studio;
  await seen(studio.editor('thymio-II'));
  await layout('Present');
  const canvas = page
    .getByRole('application', { name: /World/ })
    .or(page.getByLabel(/^World/))
    .first();
  await seen(canvas);
  const before = await pose(page, 'thymio');
  await press('F5');
  await until('it drives', async () => (await pose(page, 'thymio'))[0] > before[0] + 0.02);
  await button('Pause').first().click();
  await seen(page.getByRole('button', { name: /Paused/ }));
  const placed = await pose(page, 'thymio');
  await command('Step');
  await until('an instant passes', async () =>
    /\d\.\d{3} s/.test(await page.getByRole('button', { name: /Paused/ }).innerText()),
  );
  await page.getByRole('radio', { name: '2×' }).click();
  await press('F5');
  await seen(page.getByRole('button', { name: /Running.*2×/s }));
  // One more thing in its way, by the keyboard.
  const things = () => page.getByRole('table', { name: 'Things' }).first().getByRole('row').count();
  const count = await things();
  await canvas.focus();
  await command('World: add a box');
  await seen(page.getByText('Click where the box goes, or press Enter.'));
  await until('one more thing', async () => {
    await press('Enter');
    return (await things()) === count + 1;
  });
  await command('Simulation back to its start');
  await seen(page.getByRole('button', { name: /Ready/ }));
  await until(
    'it is back',
    async () => Math.abs((await pose(page, 'thymio'))[0] - before[0]) < 0.005,
  );
  assert.ok(Math.abs(placed[0] - before[0]) > 0.02);
});

test('the mouse drags the robot, its form presses its buttons', thymio, async (studio) => {
  const { page, press } = studio;
  await seen(studio.editor('thymio-II'));
  const { view, at, pose, stands } = await openWorld(page, 'arena.world', [2, 1.5]);
  await view.getByRole('radio', { name: 'Live' }).click();
  await pose('thymio');
  await press('F5');
  await until('it drives', async () => ((await pose('thymio'))[0] ?? 0) > 0.53);
  await view.getByRole('button', { name: 'thymio' }).click();
  // Its button in the middle stops it.
  const form = page.getByRole('region', { name: 'Properties' }).first();
  await form.getByRole('button', { name: 'Press center' }).click();
  await seen(view.getByText(/ 0 cm\/s/));
  const [x = 0, y = 0] = await pose('thymio');
  const [from, to] = [await at(x, y), await at(1.35, 0.7)];
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2, { steps: 4 });
  await page.mouse.move(to.x, to.y, { steps: 4 });
  await page.mouse.up();
  await stands('thymio', 1.35, 0.7, 0.02);
  await form.getByRole('button', { name: /^Why do its wheels turn like this/ }).click();
  await seen(page.getByRole('heading', { name: /^Why do the wheels of thymio turn/ }));
});

test('in 3D', thymio, async (studio) => {
  const { page, button, layout } = studio;
  await seen(studio.editor('thymio-II'));
  await layout('Present');
  await button('In 3D').click();
  await seen(button('From above'));
  await until('a picture is drawn', () =>
    page
      .locator('canvas')
      .first()
      .evaluate((one) => one.clientWidth > 100 && one.clientHeight > 100),
  );
});

test('a world is edited with undo and saved in the form of its file', thymio, async (studio) => {
  const { page, press, button, server } = studio;
  await seen(studio.editor('thymio-II'));
  await page.getByRole('treeitem', { name: /arena.world/ }).dblclick();
  await page.getByRole('radio', { name: 'Edit' }).click();
  // The running world, which has a list of its own, goes behind.
  await studio.command('Show Events');
  const file = join(server.data, 'projects/thymio/thymio/arena.world.json');
  const before = readFileSync(file, 'utf8');
  const table = page.getByRole('table', { name: 'Things' }).first();
  await table.getByRole('button', { name: 'table' }).click();
  await page.getByLabel('x', { exact: true }).first().fill('1.5');
  await press('Enter');
  await until('it moved', async () => (await pose(page, 'table'))[0] === 1.5);
  await press('Control+s');
  await until('it is saved', () => readFileSync(file, 'utf8').includes('"at": [1.5, 0.4]'));
  assert.equal(readFileSync(file, 'utf8').replace('[1.5, 0.4]', '[1.6, 0.4]'), before);
  await button('Undo').click();
  await until('undone', async () => (await pose(page, 'table'))[0] === 1.6);
  await press('Control+s');
  await until('as it was', () => readFileSync(file, 'utf8') === before);
});
