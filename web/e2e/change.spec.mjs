// A plan is edited while it runs: what saving will do is said before, what it did after. And a run
// that begins at an actor of one's choice.
import assert from 'node:assert/strict';
import { makeProject } from './support/robots.mjs';
import { gone, reads, seen, test } from './support/studio.mjs';
/** @import { Page, Studio, TestContext } from './support/studio.mjs' */

const kLate = {
  late: { template: 'Timeout', in: { seconds: 100000 }, events: { Timeout: 'say' } },
};
// "stay" is active for ever: what is said of it is true at any moment.
const kPlan = {
  format: 'vagus-plan/1',
  name: 'P',
  configuration: {
    seconds: { type: 'float', initial: 1000 },
    word: { type: 'string', initial: 'hello' },
  },
  start: { actor: 'stay' },
  actors: {
    stay: {
      template: 'Wait',
      in: { seconds: 'seconds' },
      states: { Done: 'say' },
      supervisors: kLate,
    },
    say: { template: 'Log', in: { text: 'word' }, states: { Done: 'hold' } },
    hold: { template: 'WaitForever' },
  },
  layout: { stay: [120, 80], say: [120, 240], hold: [120, 400] },
};
const room = {
  format: 'vagus-world/1',
  name: 'Room',
  size: [3, 3],
  robots: [{ name: 'alice', type: 'thymio2', at: [0.5, 0.5], node: 1 }],
};
const project = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(
      t,
      { name: 'Change', plan: 'P.plan.json', world: 'room.world.json', target: 'sim' },
      {
        'P.plan.json': JSON.stringify(kPlan, null, 2),
        'room.world.json': JSON.stringify(room, null, 2),
      },
    ),
};
const element = (/** @type {Page} */ page, /** @type {string} */ name) =>
  page.getByRole('group', { name, exact: false });

async function runs(/** @type {Studio} */ studio) {
  const { page, layout } = studio;
  await layout('Draw');
  await page.getByRole('switch', { name: 'What it does' }).click();
  const live = page.getByRole('complementary', { name: 'What the plan does' });
  await live.getByRole('button', { name: 'Start' }).click();
  await reads(live, /stay/);
  await reads(live, /step 1 of the run/);
  return live;
}

async function choose(/** @type {Studio} */ studio, /** @type {string} */ name) {
  await element(studio.page, name).focus();
  await studio.press('Enter');
  return studio.page.getByRole('region', { name: 'Properties' });
}

test(
  'a plan that runs takes over what is saved; the page says so before',
  project,
  async (studio) => {
    const { page, press } = studio;
    const live = await runs(studio);
    const form = await choose(studio, 'say, actor Log');
    await form.getByLabel('text').fill("word & '!'");
    await press('Enter');
    const line = page
      .getByRole('status')
      .filter({ hasText: 'Saving changes the running plan at once.' });
    await seen(line);
    await line.getByRole('button', { name: 'Save' }).click();
    await gone(line);
    await reads(live, /P: the new version runs/);
    await seen(page.getByRole('img', { name: 'saved, on the robot, running' }));
    // Drawn again while it runs: an actor that the new version brings is live.
    await reads(live, /stay/);
  },
);

test(
  'what cannot take over is refused with every reason, and runs when it starts again',
  project,
  async (studio) => {
    const { page, press } = studio;
    const live = await runs(studio);
    await choose(studio, 'stay, actor Wait');
    await element(page, 'stay, actor Wait').focus();
    await press('Delete');
    const before = page
      .getByRole('status')
      .filter({ hasText: 'The running plan cannot take this change' });
    await seen(before);
    await reads(before, /\[P15\]/);
    await press('Control+z');
    await gone(before);
    // A supervisor of the active actor, which watches.
    await element(page, 'late, supervisor Timeout').focus();
    await press('Space');
    await seen(page.getByRole('heading', { name: 'late' }));
    await press('Delete');
    await seen(before);
    await reads(before, /the supervisor "late" watches/);
    await press('Control+s');
    const after = page.getByRole('status').filter({ hasText: 'could not take what was saved' });
    await seen(after);
    await reads(after, /the supervisor "late" watches/);
    await seen(page.getByRole('img', { name: 'saved, the robot has an older one, running' }));
    await reads(live, /running/);
    await after.getByRole('button', { name: 'Stop and start again' }).click();
    await gone(after);
    await seen(page.getByRole('img', { name: 'saved, on the robot, running' }));
    await reads(live, /stay/);
  },
);

test(
  'a run begins at an actor of one’s choice with values of one’s choice',
  project,
  async (studio) => {
    const { page, press, layout } = studio;
    await layout('Draw');
    await page.getByRole('switch', { name: 'What it does' }).click();
    const live = page.getByRole('complementary', { name: 'What the plan does' });
    await element(page, 'say, actor Log').focus();
    await press('Space');
    await seen(page.getByRole('heading', { name: 'say' }));
    await press('r');
    const form = page.getByRole('dialog', { name: 'Run from say' });
    await seen(form);
    const seconds = form.getByLabel(/^seconds/);
    assert.equal(await seconds.inputValue(), '1000');
    assert.equal(await form.getByLabel(/^word/).inputValue(), 'hello');
    await seconds.fill('ten');
    await seen(form.getByText('a number'));
    assert.equal(await form.getByRole('button', { name: 'Run', exact: true }).isDisabled(), true);
    await seconds.fill('10');
    await form.getByLabel(/^word/).fill('good morning');
    await press('Enter');
    await gone(form);
    await reads(live, /good morning/);
    await reads(live, /hold/);
    assert.equal(await live.getByLabel('Value of seconds').inputValue(), '10');
  },
);

test('the menu of an actor holds what can be done with it', project, async (studio) => {
  const { page, layout, press } = studio;
  await layout('Draw');
  await element(page, 'say, actor Log').click({ button: 'right' });
  await page.getByRole('menuitem', { name: /Run from here/ }).click();
  const form = page.getByRole('dialog', { name: 'Run from say' });
  await seen(form);
  await press('Escape');
  await gone(form);
});
