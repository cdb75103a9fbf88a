// A hand in a run: it holds what drives, what it did is undone, kept in the file, and told apart from it.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { aesl, makeProject } from './support/robots.mjs';
import { gone, reads, seen, test, until } from './support/studio.mjs';
import { openWorld } from './support/world.mjs';
/** @import { TestContext, Studio } from './support/studio.mjs' */

const kRoom = {
  format: 'vagus-world/1',
  name: 'Room',
  size: [3, 3],
  objects: [
    { id: 'crate', kind: 'box', at: [2.5, 0.5], size: [0.3, 0.3] },
    { id: 'lamp', kind: 'light', at: [0.5, 2.5] },
  ],
  robots: [{ name: 'alice', type: 'thymio2', at: [0.5, 1.5], node: 1, script: 'drive.aesl' }],
};
// 3 cm/s, from the start on.
const kDrive = 'motor.left.target = 100\nmotor.right.target = 100\n';
const prepare = (/** @type {TestContext} */ t) =>
  makeProject(
    t,
    { name: 'Hand', world: 'room.world.json', scripts: ['drive.aesl'], target: 'sim' },
    {
      'drive.aesl': aesl({ 'thymio-II': kDrive }),
      'room.world.json': JSON.stringify(kRoom, null, 2),
    },
  );

/** The world as it runs, beside its list of things. */
async function live(/** @type {Studio} */ { page }) {
  const world = await openWorld(page, 'room.world', [3, 3]);
  await world.view.getByRole('radio', { name: 'Live' }).click();
  await seen(world.view.getByRole('button', { name: 'Add' }));
  return world;
}

/** Seconds of the run, as they stand over the picture. */
async function time(/** @type {Awaited<ReturnType<typeof openWorld>>} */ { view }) {
  const chip = await view.locator('.world__chip').filter({ hasText: ' s' }).first().innerText();
  return parseFloat(chip);
}

test(
  'a robot that drives is held, dragged, put back by undo, and kept',
  { prepare },
  async (studio) => {
    const { page, press, place } = studio;
    const world = await live(studio);
    const { view, at, pose, stands } = world;
    await press('F5');
    await until('it drives', async () => ((await pose('alice'))[0] ?? 0) > 0.53);
    // Held still for a second: in the run, too.
    const [x0 = 0, y0 = 0] = await pose('alice');
    const grip = await at(x0, y0);
    await page.mouse.move(grip.x, grip.y);
    await page.mouse.down();
    const since = await time(world);
    await until('a second of the run passes', async () => (await time(world)) > since + 1);
    await press('F8');
    await seen(page.getByRole('button', { name: /Paused/ }));
    await page.mouse.up();
    const held = await pose('alice');
    // A second and more of 3 cm/s, but for what it did until the press was one.
    assert.ok((held[0] ?? 9) < x0 + 0.028, `it drove on from ${x0} to ${held[0]}`);
    // Dragged to another place, while time stands.
    const from = await at(held[0] ?? 0, held[1] ?? 0);
    const to = await at(2, 2.5);
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2, { steps: 4 });
    await page.mouse.move(to.x, to.y, { steps: 4 });
    await page.mouse.up();
    await stands('alice', 2, 2.5);
    const notes = view.getByRole('status').filter({ hasText: 'changed in this run' });
    await reads(notes, /1 thing changed in this run/);
    await press('Control+z');
    await stands('alice', held[0] ?? 0, held[1] ?? 0);
    await press('Control+y');
    await stands('alice', 2, 2.5);
    // The crate goes, and comes back with its name and all it has.
    await view.getByRole('button', { name: 'crate' }).click();
    await view.getByRole('application').focus();
    await press('Delete');
    await until('no crate', async () => !(await world.names()).includes('crate'));
    await reads(notes, /2 things changed/);
    await press('Control+z');
    await until('the crate', async () => (await world.names()).includes('crate'));
    await stands('crate', 2.5, 0.5);
    await press('Control+y');
    await reads(notes, /2 things changed/);
    await view.getByRole('button', { name: 'Keep in the world' }).click();
    await gone(notes);
    // What the run shows is no news.
    assert.equal(await view.getByText('The world file has changed').count(), 0);
    // One step of the file: smallest change, undone at once.
    await view.getByRole('radio', { name: 'Edit' }).click();
    await stands('alice', 2, 2.5);
    await view.getByRole('button', { name: 'Undo' }).click();
    await stands('alice', 0.5, 1.5);
    assert.ok((await world.names()).includes('crate'));
    await view.getByRole('button', { name: 'Redo' }).click();
    await stands('alice', 2, 2.5);
    await view.getByRole('application').focus();
    await press('Control+s');
    const file = join(place, 'room.world.json');
    const whole = () => JSON.parse(readFileSync(file, 'utf8'));
    await until('it is saved', () => whole().objects.length === 1);
    const [robot] = whole().robots;
    assert.ok(Math.hypot(robot.at[0] - 2, robot.at[1] - 2.5) < 0.02, JSON.stringify(robot));
    assert.deepEqual(whole().objects, [kRoom.objects[1]]);
  },
);

test(
  'before a run an edit of the file shows at once, in a run after a restart',
  { prepare },
  async (studio) => {
    const { press, place } = studio;
    const world = await live(studio);
    const { view, stands } = world;
    const form = view.getByRole('region', { name: 'Properties' });
    const shove = async (/** @type {string} */ x) => {
      await view.getByRole('radio', { name: 'Edit' }).click();
      if (!(await form.getByLabel('x', { exact: true }).isVisible()))
        await view.getByRole('button', { name: 'crate' }).click();
      await reads(form.locator('.props__kind'), /in the file/);
      await form.getByLabel('x', { exact: true }).fill(x);
      await press('Enter');
      await view.getByRole('radio', { name: 'Live' }).click();
    };
    await shove('2');
    await stands('crate', 2, 0.5);
    assert.deepEqual(JSON.parse(readFileSync(join(place, 'room.world.json'), 'utf8')), kRoom);
    await press('F5');
    await until('it runs', async () => (await time(world)) > 0.1);
    await shove('1.5');
    await stands('crate', 2, 0.5);
    const mark = view.getByRole('status').filter({ hasText: 'The world file has changed' });
    await mark.getByRole('button', { name: 'Restart' }).click();
    await stands('crate', 1.5, 0.5);
    await gone(mark);
  },
);

test('what Live and Edit change is said, once in words', { prepare }, async (studio) => {
  const { page } = studio;
  const { view } = await live(studio);
  const note = view.getByRole('note');
  await reads(note, /what you move or add here is gone after it/);
  await view.getByRole('radio', { name: 'Edit' }).click();
  await reads(note, /Edit changes the file/);
  await note.getByRole('button', { name: 'Got it' }).click();
  await gone(note);
  await page.reload();
  await seen(view.getByRole('radio', { name: 'Live' }));
  await view.getByRole('radio', { name: 'Live' }).hover();
  await seen(page.getByText('The world of the run.', { exact: false }));
  assert.equal(await note.count(), 0);
});

test('what was done by hand is undone after a reload', { prepare }, async (studio) => {
  const { page, press } = studio;
  const world = await live(studio);
  await world.view.getByRole('button', { name: 'crate' }).click();
  await world.view.getByRole('application').focus();
  await press('Delete');
  await until('no crate', async () => !(await world.names()).includes('crate'));
  await seen(world.view.getByRole('button', { name: 'Undo', disabled: false }));
  await page.reload();
  const again = await live(studio);
  await seen(again.view.getByText(/1 thing changed in this run/));
  await again.view.getByRole('button', { name: 'Undo' }).click();
  await until('the crate', async () => (await again.names()).includes('crate'));
});

test('trails survive a reload and another view', { prepare }, async (studio) => {
  const { page, press } = studio;
  const world = await live(studio);
  const { view, pose, colour } = world;
  await press('F5');
  await until('it has driven 20 cm', async () => ((await pose('alice'))[0] ?? 0) > 0.7);
  await press('F8');
  await seen(page.getByRole('button', { name: /Paused/ }));
  const isDrawn = () =>
    until('a trail is drawn', async () => {
      const [on, off] = [await colour(0.56, 1.5), await colour(0.56, 1.35)];
      return on.length === 3 && String(on) !== String(off);
    });
  await isDrawn();
  await page.reload();
  await seen(view.getByRole('radio', { name: 'Live' }));
  await view.getByRole('radio', { name: 'Live' }).click();
  await pose('alice');
  await isDrawn();
  await view.getByRole('radio', { name: 'Edit' }).click();
  await view.getByRole('radio', { name: 'Live' }).click();
  await isDrawn();
  // Without trails there is only the ground.
  await view.getByRole('button', { name: 'Trails' }).click();
  await until('no trail', async () => {
    const [on, off] = [await colour(0.56, 1.5), await colour(0.56, 1.35)];
    return String(on) === String(off);
  });
});
