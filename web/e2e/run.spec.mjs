// F5 runs what is on the screen: the top bar says what runs, and what cannot run is said where F5 was pressed.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { makeProject } from './support/robots.mjs';
import { gone, seen, test, until } from './support/studio.mjs';
/** @import { Page, TestContext } from './support/studio.mjs' */

const world = JSON.stringify({
  format: 'vagus-world/1',
  size: [2, 2],
  robots: [{ name: 'thymio', type: 'thymio2', at: [1, 1] }],
});
const plan = (
  /** @type {string} */ name,
  /** @type {Record<string, string>} */ states = { Done: '@terminate' },
) =>
  JSON.stringify({
    format: 'vagus-plan/1',
    name,
    start: { actor: 'wait' },
    actors: { wait: { template: 'Wait', in: { seconds: 1000 }, states } },
    layout: { wait: [80, 96] },
  });
/** vagus.json names no plan, as that of a new project for a robot. */
const files = {
  'w.world.json': world,
  'First.plan.json': plan('First'),
  'Second.plan.json': plan('Second'),
  'Broken.plan.json': plan('Broken', {}),
};
const none = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(t, { name: 'None', world: 'w.world.json' }, files),
};
const open = (/** @type {Page} */ page, /** @type {string} */ name) =>
  page.locator(`[role="treeitem"][data-path="${name}"]`).click();
const shows = (/** @type {Page} */ page, /** @type {string} */ name) =>
  seen(page.getByRole('region', { name: `Plan ${name}, drawn` }));

test('F5 in a plan runs that plan, and the last one from anywhere else', none, async (studio) => {
  const { page, press, layout, button, place } = studio;
  await layout('Script');
  await open(page, 'First.plan.json');
  await shows(page, 'First');
  await press('F5');
  await seen(button(/Running: First/));
  await open(page, 'Second.plan.json');
  await shows(page, 'Second');
  await press('F5');
  await seen(button(/Running: Second/));
  await press('Shift+F5');
  await gone(button(/Running/));
  await until('it is kept with the project', () =>
    readFileSync(join(place, '.vagus/state.json'), 'utf8').includes('Second.plan.json'),
  );
  await open(page, 'w.world.json');
  await seen(page.getByRole('tab', { name: /^w\.world/, selected: true }));
  await press('F5');
  await seen(button(/Running: Second/));
});

test(
  'a plan with an error is not started; what still runs is said where F5 was pressed',
  none,
  async (studio) => {
    const { page, press, layout, button } = studio;
    await layout('Script');
    await open(page, 'First.plan.json');
    await shows(page, 'First');
    await press('F5');
    await seen(button(/Running: First/));
    await open(page, 'Broken.plan.json');
    await shows(page, 'Broken');
    await seen(page.getByRole('button', { name: /1 error/ }));
    await press('F5');
    const said = page
      .getByRole('alert')
      .filter({ hasText: 'Broken has 1 error and was not started. First is still running.' });
    await seen(said);
    await said.getByRole('button', { name: 'Dismiss' }).click();
    await gone(said);
  },
);

test(
  'a project with neither world nor robot says so beside the target, and leads to one',
  { prepare: (t) => makeProject(t, { name: 'Bare' }, { 'First.plan.json': plan('First') }) },
  async ({ page, button }) => {
    await button(/^No world or robot/).click();
    await seen(page.getByText('No robot found yet.', { exact: false }));
  },
);
