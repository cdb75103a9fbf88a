// Walks through worlds and plans by keyboard and mouse against the stand-in, and says what does not
// work: npm run walk:world
import assert from 'node:assert/strict';
import { openStudio } from './browser.mjs';

const { page, server, problems, close } = await openStudio({});
const { model } = server;
const path = 'follow-wall/hall.world.json';
const world = () => JSON.parse(model.docs.get(path).text);
const until = async (what, check) => {
  for (let turn = 0; turn < 80; turn++) {
    if (await check()) return;
    await page.waitForTimeout(100);
  }
  assert.fail(what);
};
const stage = page.getByRole('application').first();
const bar = page.locator('.world__bar');
const steps = {
  async 'a world opens as its file says'() {
    await page
      .getByRole('treeitem', { name: /hall\.world/ })
      .first()
      .dblclick();
    await page.getByRole('button', { name: 'pier', exact: true }).waitFor();
  },
  async 'arrows move, brackets turn, Ctrl+Z takes it back'() {
    await page.getByRole('button', { name: 'pier', exact: true }).click();
    await stage.focus();
    await page.keyboard.press('ArrowRight');
    await until('1 cm', () => world().objects[0].at[0] === 3.61);
    await page.keyboard.press('Shift+ArrowUp');
    await until('10 cm', () => world().objects[0].at[1] === 0.5);
    await page.keyboard.press(']');
    await until('5 degrees', () => Math.abs(world().objects[0].angle + 0.0873) < 1e-3);
    for (let turn = 0; turn < 3; turn++) await page.keyboard.press('Control+z');
    await until('all is back', () => world().objects[0].at[0] === 3.6 && !world().objects[0].angle);
  },
  async 'N goes to the next thing and says where it stands'() {
    await page.keyboard.press('n');
    await until('it is said', async () =>
      /column: 2\.40, 3\.00 m/.test(await stage.getByRole('status').innerText()),
    );
  },
  async 'the mouse drags a thing onto the grid'() {
    const frame = await stage.boundingBox();
    const size = world().size;
    const scale = Math.min(
      (frame.width - 20) / (size[0] + 0.12),
      (frame.height - 20) / (size[1] + 0.12),
    );
    const place = (x, y) => [
      frame.x + frame.width / 2 + (x - size[0] / 2) * scale,
      frame.y + frame.height / 2 - (y - size[1] / 2) * scale,
    ];
    await page.mouse.move(...place(2.4, 3));
    await page.mouse.down();
    await page.mouse.move(...place(2.6, 2.8), { steps: 4 });
    await page.mouse.move(...place(3.01, 2.51), { steps: 4 });
    await page.mouse.up();
    await until('it is there', () => {
      const [x, y] = world().objects[1].at;
      return Math.abs(x - 3) < 0.051 && Math.abs(y - 2.5) < 0.051;
    });
    const [x] = world().objects[1].at;
    assert.ok(Math.abs(x / 0.05 - Math.round(x / 0.05)) < 1e-6, `${x} is not on the grid`);
  },
  async 'something new is put down with Enter'() {
    await bar.getByRole('button', { name: 'Add' }).click();
    await page.getByRole('menuitem', { name: 'Cylinder' }).click();
    await until('the picture has the focus', () =>
      page.evaluate(() => document.activeElement?.getAttribute('role') === 'application'),
    );
    await page.keyboard.press('Enter');
    await until('a third object', () => world().objects.length === 3);
  },
  async 'numbers are typed exactly'() {
    const form = page.locator('.props');
    await form.getByLabel('Radius').fill('0.123');
    await page.keyboard.press('Enter');
    await until('the radius', () => world().objects[2].radius === 0.123);
    await form.getByLabel('Radius').fill('nothing');
    assert.equal(await form.getByLabel('Radius').getAttribute('aria-invalid'), 'true');
    await page.keyboard.press('Escape');
  },
  async 'Delete takes it away'() {
    await stage.focus();
    await page.keyboard.press('Delete');
    await until('two objects', () => world().objects.length === 2);
  },
  async 'an entry of the timeline is added and moved in time'() {
    await page.getByRole('button', { name: 'Add an entry' }).click();
    await until('five entries', () => world().timeline.length === 5);
    await page.locator('.props').getByLabel('At').fill('60');
    await page.keyboard.press('Enter');
    await until('its place', () => world().timeline[1].t === 60);
  },
  async 'the text shows the same'() {
    await page.getByRole('radio', { name: 'Text' }).click();
    await page.getByRole('textbox', { name: /Text of hall/ }).waitFor();
    await page.getByRole('radio', { name: 'Edit' }).click();
  },
  async 'the running world is moved by hand'() {
    await page.keyboard.press('F5');
    await page.getByRole('radio', { name: 'Live' }).click();
    await page.getByRole('button', { name: 'carbot', exact: true }).click();
    await page.keyboard.press('F8');
    await stage.focus();
    const { x } = model.world.poses.get('carbot');
    await page.keyboard.press('Shift+ArrowRight');
    await until('the robot', () => Math.abs(model.world.poses.get('carbot').x - x - 0.1) < 0.011);
  },
  async 'an obstacle is put into it'() {
    const before = model.world.scene.objects.length;
    await bar.getByRole('button', { name: 'Add' }).click();
    await page.getByRole('menuitem', { name: 'Box' }).click();
    await page.waitForTimeout(200);
    await page.keyboard.press('Enter');
    await until('one more', () => model.world.scene.objects.length === before + 1);
    await page.getByRole('button', { name: 'Take away' }).click();
    await until('gone again', () => model.world.scene.objects.length === before);
  },
  async 'the plan starts, a variable is set, the plan stops'() {
    await page
      .getByRole('treeitem', { name: /WallFollow/ })
      .first()
      .dblclick();
    await page.getByRole('button', { name: 'Start', exact: true }).click();
    await page.getByText('searchFirstWall', { exact: true }).first().waitFor();
    await page.getByLabel('Value of walldist').fill('25');
    await page.keyboard.press('Enter');
    await until('the value', () => model.plan.walldist === 25);
    await page
      .getByRole('button', { name: 'Stop the plan' })
      .or(page.locator('.planlive .is-stop'))
      .first()
      .click();
    await until('the end', () => model.plan.state === 'ended');
  },
};

let failed = 0;
for (const [name, step] of Object.entries(steps)) {
  try {
    await step();
    console.log(`ok      ${name}`);
  } catch (error) {
    failed++;
    console.log(`FAILED  ${name}: ${String(error).slice(0, 300)}`);
    await page.screenshot({ path: `shots/walk-world-${failed}.png` }).catch(() => {});
  }
}
if (problems.length) console.log(problems);
await close();
process.exit(failed ? 1 : 0);
