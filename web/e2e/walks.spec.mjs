// What newcomers met on their first walks: with keys alone, with a finger, in a window on its end.
import assert from 'node:assert/strict';
import { makeProject, twoNodes } from './support/robots.mjs';
import { boxOf, focused, gone, reads, seen, test, until } from './support/studio.mjs';
/** @import { TestContext } from './support/studio.mjs' */

const upright = { width: 820, height: 1180, touch: true };
const kWait = { template: 'Wait', in: { seconds: 1 }, states: { Done: '@terminate' } };
const planOf = (/** @type {string} */ name) =>
  JSON.stringify({
    format: 'vagus-plan/1',
    name,
    start: { actor: 'wait' },
    actors: { wait: kWait },
    layout: { wait: [80, 96] },
  });
const twoPlans = (/** @type {TestContext} */ t) =>
  makeProject(
    t,
    { name: 'T', plan: 'P.plan.json', scripts: ['s.aesl'] },
    { 'P.plan.json': planOf('P'), 'Q.plan.json': planOf('Q') },
  );
const nodes = (/** @type {TestContext} */ t) =>
  twoNodes(t, { left: 'var a = 0\na = 1\na = 2\n', right: '' });

test(
  'a project that was created by keys has the keyboard',
  {},
  async ({ page, press, type, editor }) => {
    await press('Alt+n');
    await focused(page.getByRole('textbox', { name: 'Name' }));
    await type('keys');
    await press('Enter');
    await focused(editor('thymio-II'));
    await press('Control+Home');
    await type('# typed at once');
    await reads(editor('thymio-II'), /# typed at once/);
    // Another one begins in a sheet as small as on the start screen, also where that was never shown.
    await page.reload();
    await seen(editor('thymio-II'));
    assert.equal(await page.evaluate(() => document.activeElement?.tagName), 'BODY');
    await press('Alt+n');
    const sheet = page.getByRole('dialog', { name: 'New project' }).locator('form');
    assert.ok((await boxOf(sheet)).width <= 400);
  },
);

test(
  'letters typed before a form is loaded are in its field',
  {},
  async ({ page, press, type, editor }) => {
    let come = () => {};
    const typed = new Promise((done) => (come = () => done(undefined)));
    await page.route('**/assets/new_project-*.js', async (route) => {
      await typed;
      await route.continue();
    });
    await seen(page.getByRole('heading', { name: 'Start' }));
    const asked = page.waitForRequest('**/assets/new_project-*.js');
    await press('Alt+n');
    await type('ahead');
    await asked;
    await type('-of me');
    await press('Backspace', 'Backspace');
    await type('it');
    come();
    const name = page.getByRole('textbox', { name: 'Name' });
    await until('all of it is there', async () => (await name.inputValue()) === 'ahead-of it');
    await type('s end');
    assert.equal(await name.inputValue(), 'ahead-of its end');
    // The same up to the Enter that creates it; the part is loaded by now.
    await press('Escape', 'Alt+n');
    await type('early');
    await press('Enter');
    await seen(editor('thymio-II'));
    await seen(page.getByRole('banner').getByText('early'));
  },
);

test('what is half typed in a form is of its own file', { prepare: twoPlans }, async (studio) => {
  const { page, layout, type, tab } = studio;
  await layout('Draw');
  await page.getByRole('treeitem', { name: 'Q.plan' }).or(tab('Project')).first().click();
  await page.getByRole('treeitem', { name: 'Q.plan' }).dblclick();
  await seen(page.getByRole('region', { name: 'Plan Q, drawn' }));
  await page.getByRole('group', { name: /^wait, actor Wait/ }).click();
  await page.getByRole('region', { name: 'Properties' }).getByLabel('seconds').click();
  await type('5');
  const mark = (/** @type {string} */ plan) =>
    tab(new RegExp(`^${plan}`)).getByRole('img', { name: /saved/ });
  await seen(mark('Q').and(page.getByRole('img', { name: /^not saved/ })));
  await seen(mark('P').and(page.getByRole('img', { name: /^saved/ })));
});

test(
  'in a window on its end a tap on a number shows a breakpoint',
  { ...upright, prepare: nodes },
  async ({ page, layout, editor }) => {
    await layout('Script');
    await seen(editor('left'));
    const number = page.locator('.cm-lineNumbers .cm-gutterElement').filter({ hasText: /^3$/ });
    await number.first().tap();
    const disc = page.locator('.cm-breaks .disc[title^="Breakpoint on line 3"]');
    await seen(disc);
    assert.equal((await boxOf(disc)).width, 10);
  },
);

test(
  'a narrow list of variables shows whole names; a tap on one offers to watch it',
  { ...upright, height: 860, words: ['--example', 'thymio'] },
  async ({ page, layout, tab }) => {
    await layout('Script');
    const list = page.getByRole('list', { name: 'Variables' });
    const name = list.getByText('motor.right.target', { exact: true });
    await seen(name);
    assert.ok(await name.evaluate((one) => one.scrollWidth <= one.clientWidth), 'it is cut off');
    await name.tap();
    await list.getByRole('button', { name: 'Watch motor.right.target' }).tap();
    await tab('Watch').tap();
    await seen(page.getByRole('list', { name: 'Watch' }).getByText('motor.right.target'));
  },
);

test(
  'each layout keeps its own panels, however fast they are changed',
  { prepare: twoPlans },
  async ({ page, layout, tab }) => {
    const names = async () =>
      (await page.getByRole('tab').allInnerTexts()).map((one) => one.trim().split('\n')[0]);
    await layout('Draw');
    await seen(tab('Palette'));
    for (let round = 0; round < 3; round++)
      for (const name of ['Script', 'Debug', 'Draw', 'Present', 'Script', 'Draw']) {
        await layout(name);
        const other = page.getByRole('tab').filter({ hasNotText: /plan/ }).last();
        if (round > 0 && (await other.isVisible())) await other.click();
      }
    await until('what was changed last is kept', async () => {
      await page.reload();
      await seen(page.getByRole('tab'));
      return (
        (await page.getByRole('radio', { name: 'Draw' }).isChecked()) && (await names()).length > 4
      );
    });
    assert.ok((await names()).includes('Palette'), String(await names()));
    assert.ok(!(await names()).includes('Variables'));
    await layout('Script');
    await seen(tab('Variables'));
    assert.ok(!(await names()).includes('Palette'));
  },
);

test(
  'what Enter makes for an arrow is selected, and its form is shown',
  { prepare: twoPlans },
  async ({ page, layout, press, type }) => {
    await layout('Draw');
    const wait = page.getByRole('group', { name: /^wait, actor Wait/ });
    await wait.getByRole('button', { name: /^Done leads to @terminate/ }).focus();
    await press('Enter');
    await focused(page.getByRole('textbox', { name: 'Actor or template' }));
    await type('Log');
    await press('Enter');
    await focused(page.getByRole('group', { name: /^log, actor Log/ }));
    const form = page.getByRole('region', { name: 'Properties' });
    await seen(form.getByRole('heading', { name: 'log' }));
  },
);

test(
  'a tablet on its end shows the robot below the script that it runs',
  { ...upright, words: ['--example', 'thymio'] },
  async ({ page, layout, button }) => {
    await layout('Script');
    await button('Run').first().tap();
    await seen(button(/Running/));
    const [text, world] = [
      await boxOf(page.locator('.cm-scroller')),
      await boxOf(page.getByRole('application', { name: /^World/ })),
    ];
    assert.ok(text.y + text.height <= world.y && world.y + world.height <= upright.height);
    assert.ok(world.width > 300 && world.height > 300, JSON.stringify(world));
  },
);

test(
  'a name that no variable has is refused where it is typed',
  { prepare: nodes },
  async (studio) => {
    const { page, layout, command, type, press } = studio;
    await layout('Script');
    await command('Plot a variable');
    await focused(page.getByRole('combobox', { name: 'node.variable' }));
    await type('wheel');
    await press('Enter');
    await seen(page.getByRole('alert').getByText('Neither a node nor the running plan has'));
    await press('Control+a');
    await type('left.a');
    await gone(page.getByRole('alert'));
  },
);

test(
  'a plot of a value that stays as it is begins with it',
  { words: ['--example', 'thymio'] },
  async ({ page, layout, press, button }) => {
    await layout('Script');
    await press('F5');
    await seen(button(/Running/));
    // Its value is shown already, and nothing changes it.
    const row = page.getByRole('list', { name: 'Variables' }).getByRole('listitem');
    const size = row.filter({ hasText: /^_productId/ });
    await reads(size, /8/);
    await button('Plot _productId').click();
    await reads(page.getByRole('list', { name: 'Curves' }).getByRole('listitem'), /_productId.*8/s);
  },
);
