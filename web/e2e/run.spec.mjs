// F5 runs what is on the screen: the top bar says what runs, and what cannot run is said where F5 was pressed.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { aesl, makeProject } from './support/robots.mjs';
import { temporaryFolder } from './support/server.mjs';
import { focused, gone, seen, test, until } from './support/studio.mjs';
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

test(
  'a plan that was opened alone runs once its folder is a project',
  {
    prepare(t) {
      const folder = temporaryFolder(t);
      const place = join(folder, 'plans');
      mkdirSync(place);
      const file = join(place, 'First.plan.json');
      writeFileSync(file, plan('First'));
      return { folder, place, words: [file] };
    },
  },
  async ({ page, button, press, place }) => {
    const made = ['.vagus', 'First.aesl', 'First.plan.json', 'First.world.json', 'vagus.json'];
    await shows(page, 'First');
    await press('F5');
    await seen(page.getByText('opened without a project; use Make a project', { exact: false }));
    await button(/^Make a project/).click();
    await seen(button(/Simulator/));
    await gone(button(/^Make a project/));
    assert.deepEqual(readdirSync(place).sort(), made);
    await press('F5');
    await seen(button(/Running: First/));
  },
);

test(
  'buttons lead to the arrow and the value that a plan lacks, and the note of F5 goes with them',
  {
    prepare: (t) =>
      makeProject(
        t,
        { name: 'Lacks', world: 'w.world.json' },
        {
          'w.world.json': world,
          'P.plan.json': JSON.stringify({
            format: 'vagus-plan/1',
            name: 'P',
            start: {},
            actors: { wait: { template: 'Wait' } },
            layout: { wait: [240, 96] },
          }),
        },
      ),
  },
  async ({ page, press, type, layout, button }) => {
    await layout('Draw');
    await shows(page, 'P');
    await press('F5');
    const note = page.getByRole('alert').filter({ hasText: 'P has 3 errors and was not started.' });
    await seen(note);
    const notice = page.getByRole('status').filter({ hasText: 'draw an arrow from Start' });
    await notice.getByRole('button', { name: 'Connect to…' }).click();
    await page.getByRole('menuitem', { name: 'wait', exact: true }).click();
    await page
      .getByRole('status')
      .filter({ hasText: 'needs a value' })
      .getByRole('button', { name: 'Enter a value' })
      .click();
    const field = page.getByRole('combobox', { name: 'seconds' });
    await until('the field has the focus', () =>
      field.evaluate((/** @type {any} */ one) => one === document.activeElement),
    );
    await type('1000');
    await press('Enter');
    await page
      .getByRole('status')
      .filter({ hasText: 'say what comes next' })
      .getByRole('button', { name: 'Connect to…' })
      .click();
    await page.getByRole('menuitem', { name: 'terminate', exact: true }).click();
    await gone(note);
    await press('F5');
    await seen(button(/Running: P/));
  },
);

test(
  'F5 in the active sub-plan leaves the run as it is',
  {
    prepare: (t) =>
      makeProject(
        t,
        { name: 'Sub', world: 'w.world.json' },
        {
          'w.world.json': world,
          'Sub.plan.json': plan('Sub', { Done: '@terminate' }),
          'Outer.plan.json': JSON.stringify({
            format: 'vagus-plan/1',
            name: 'Outer',
            start: { actor: 'sub' },
            actors: {
              sub: {
                plan: 'Sub.plan.json',
                states: { OK: '@terminate', Interrupted: '@terminate', Error: '@terminate' },
              },
            },
          }),
        },
      ),
  },
  async ({ page, press, layout, button, place, command }) => {
    await layout('Script');
    await open(page, 'Outer.plan.json');
    await shows(page, 'Outer');
    await command('Start this plan');
    await seen(button(/Running: Outer/));
    await until('the plan that was started so is the last one, too', () =>
      readFileSync(join(place, '.vagus/state.json'), 'utf8').includes('Outer.plan.json'),
    );
    await open(page, 'Sub.plan.json');
    await shows(page, 'Sub');
    await press('F5', 'F8');
    await seen(button(/Paused/));
    await press('F5');
    await seen(button(/Running: Outer/));
  },
);

test(
  'on a telephone F5 with an error in the plan is answered by a message',
  {
    width: 390,
    height: 844,
    prepare: (t) =>
      makeProject(
        t,
        { name: 'Phone', world: 'w.world.json', plan: 'Broken.plan.json' },
        { 'w.world.json': world, 'Broken.plan.json': plan('Broken', {}) },
      ),
  },
  async ({ page }) => {
    await page.getByRole('button', { name: 'Run', exact: true }).click();
    await seen(
      page
        .getByRole('log', { name: 'Messages' })
        .getByText('Broken has 1 error and was not started.'),
    );
  },
);

test(
  'a fault in the simulator pauses the clock with the node',
  {
    prepare: (t) =>
      makeProject(
        t,
        { name: 'Fault', world: 'w.world.json', scripts: ['f.aesl'] },
        {
          'w.world.json': world,
          'f.aesl': aesl({ 'thymio-II': 'var a\nvar b\nonevent buttons\nb = b / (a - a)\n' }),
        },
      ),
  },
  async ({ page, press, button }) => {
    await seen(page.getByRole('textbox', { name: /^Script of/ }));
    await press('F5');
    await seen(button(/Paused/));
    await gone(button(/Running/));
    await seen(button('Continue'));
    await seen(page.getByText('thymio-II paused at line 4'));
  },
);

test(
  'a project without a plan gets one: Present shows it, and its canvas leads to the palette',
  {
    prepare: (t) =>
      makeProject(t, { name: 'Late', world: 'w.world.json' }, { 'w.world.json': world }),
  },
  async ({ page, press, type, layout, command, tab }) => {
    await layout('Present');
    await layout('Script');
    await command('New plan');
    await focused(page.getByRole('textbox', { name: 'Name of the new file' }));
    await type('Mine');
    await press('Enter');
    await shows(page, 'Mine');
    await page.getByRole('group', { name: /^wait, actor/ }).focus();
    await press('Space', 'Delete');
    await page.getByRole('button', { name: 'Show Palette' }).click();
    await seen(tab('Palette'));
    await layout('Present');
    await shows(page, 'Mine');
  },
);

test(
  'the top bar stays in one line when the plan has ended and scripts run on',
  { words: ['--example', 'follow-wall'] },
  async (studio) => {
    const { page, press, button } = studio;
    await button(/Speed of the clock/).click();
    await page.getByRole('menuitem', { name: /As fast as/i }).click();
    await press('F5');
    await seen(page.getByText(/scripts run/));
    const top = (/** @type {string} */ part) =>
      page.locator(part).evaluate((one) => one.getBoundingClientRect().top);
    const bottom = (/** @type {string} */ part) =>
      page.locator(part).evaluate((one) => one.getBoundingClientRect().bottom);
    assert.ok((await top('.topbar__tools')) < (await bottom('.runbar')), 'in one line');
  },
);
