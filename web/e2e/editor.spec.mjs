// The script editor: what the compiler knows is where it is wanted.
import assert from 'node:assert/strict';
import { twoNodes } from './support/robots.mjs';
import { gone, reads, seen, test, until } from './support/studio.mjs';
/** @import { Studio, TestContext } from './support/studio.mjs' */

const scripts = {
  left: `var speed = 0
onevent go
speed = LIMIT
emit done speed
`,
  right: `var seen = 0
onevent done
seen = args[0]
if seen > LIMIT then
seen = LIMIT
end
`,
};
const shared = { events: { go: 0, done: 1 }, constants: { LIMIT: 100 } };
const two = { prepare: (/** @type {TestContext} */ t) => twoNodes(t, scripts, shared) };

async function open(/** @type {Studio} */ studio, node = 'left') {
  await seen(studio.editor('left'));
  await studio.tab(new RegExp(`^${node}`)).click();
  await studio.editor(node).click();
}
const textOf = async (/** @type {Studio} */ studio, /** @type {string} */ node) =>
  (await studio.editor(node).innerText()).replaceAll('\u200b', '');

test('what can be written here is offered, with help and signature', two, async (studio) => {
  const { page, press, type } = studio;
  await open(studio);
  await press('Control+End');
  await type('call math.st');
  await seen(page.getByRole('option', { name: /math\.stat/ }));
  await press('Tab');
  await until('it is there', async () => /call math\.stat/.test(await textOf(studio, 'left')));
  await press('End', 'Enter');
  await type('speed = LIM');
  await seen(page.getByRole('option', { name: /LIMIT/ }));
  await press('Escape');
  // Help under the pointer.
  await page.locator('.cm-line', { hasText: 'speed = LIMIT' }).getByText('LIMIT').hover();
  await seen(page.locator('.hover').getByText(/LIMIT/));
});

test('mistakes are told while typing, and fixed by their buttons', two, async (studio) => {
  const { page, press, type, button } = studio;
  await open(studio);
  await press('Control+End');
  await type('spede = 1');
  await seen(page.getByRole('note').getByText(/spede/));
  await seen(page.getByRole('button', { name: '1 error' }));
  await press('Alt+Enter');
  await until('did you mean', async () => /\nspeed = 1/.test(await textOf(studio, 'left')));
  await gone(page.getByRole('note'));

  await press('Control+End', 'Enter');
  await type('emit hello');
  await press('Escape');
  await page.getByRole('note').getByRole('button').first().click();
  await seen(button('No problems'));
  await button(/^Events of the project/).click();
  await page.getByText('hello', { exact: true }).last().hover();
  await seen(button('Send hello'));

  await studio.editor('left').click();
  await press('Control+End', 'Enter');
  await type('if speed > 1 then');
  await press('Enter');
  await type('speed = 1');
  await seen(page.getByRole('note'));
  await press('Alt+Enter');
  await seen(button('No problems'));
  assert.match(await textOf(studio, 'left'), /\n\s*end\s*$/);
});

test('problems of all files are one list, F4 goes to the next', two, async (studio) => {
  const { page, press, type } = studio;
  await open(studio);
  await press('Control+End');
  await type('nothing = 1');
  await press('Escape');
  await open(studio, 'right');
  await press('Control+End');
  await type('nobody = 1');
  await press('Escape');
  const list = page.getByRole('list', { name: 'Problems of all files' });
  await seen(list.getByText(/nothing/));
  await seen(list.getByText(/nobody/));
  await press('F4');
  await seen(studio.tab(/^left.*/).and(page.locator('[aria-selected=true]')));
  await seen(page.getByText('Ln 5, Col 1'));
  await press('F4');
  await seen(studio.tab(/^right.*/).and(page.locator('[aria-selected=true]')));
  await seen(page.getByText('Ln 7, Col 1'));
});

test('names: definition, references, renaming in all scripts', two, async (studio) => {
  const { page, press } = studio;
  await open(studio);
  await press('Control+Home', 'ArrowDown', 'ArrowDown', 'F12');
  await seen(page.getByText('Ln 1, Col 5'));
  await press('Control+Home', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'Control+ArrowRight');
  await press('ArrowRight', 'ArrowRight', 'Shift+F12');
  await seen(page.getByText('Where “done” is used'));
  await studio.editor('left').click();
  await press('Control+Home', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'Control+ArrowRight');
  await press('ArrowRight', 'ArrowRight', 'F2');
  await page.getByLabel('New name').fill('arrived');
  await press('Enter');
  await seen(page.getByText(/places in .* renamed/));
  await until('here', async () => (await textOf(studio, 'left')).includes('emit arrived'));
  await open(studio, 'right');
  await until('there', async () => (await textOf(studio, 'right')).includes('onevent arrived'));
  await studio.button(/^Events of the project/).click();
  await seen(page.getByRole('button', { name: 'Send arrived' }));
});

test('search and replace over all files', two, async (studio) => {
  const { page, press, button } = studio;
  await open(studio);
  await press('Control+Shift+F');
  await page.getByLabel('Find', { exact: true }).fill('LIMIT');
  await press('Enter');
  await seen(page.getByText(/places in 2 texts|places in 3 texts/));
  await page.getByLabel('Find', { exact: true }).fill('seen');
  await page.getByLabel('Replace with').fill('heard');
  await button('Replace all').click();
  await seen(page.getByText(/places in .* replaced/));
  await open(studio, 'right');
  await until('replaced', async () => (await textOf(studio, 'right')).includes('var heard = 0'));
});

test('memory, bytecode, two scripts side by side, undo', two, async (studio) => {
  const { page, press, type, button, command } = studio;
  await open(studio);
  await seen(page.getByRole('meter', { name: 'Bytecode' }));
  await reads(page.getByText(/\/ 512 words/).first(), /\d+ \/ 512 words/);
  await button('Bytecode beside the text').click();
  await seen(
    page.getByRole('list', { name: 'Bytecode' }).getByText('Emit done, 1 word from speed'),
  );
  await open(studio, 'right');
  await command('Open to the side');
  await seen(studio.editor('left'));
  await seen(studio.editor('right'));
  await studio.editor('left').click();
  await press('Control+End');
  await type('speed = 7');
  await until('typed', async () => (await textOf(studio, 'left')).includes('speed = 7'));
  await press('Escape', 'Control+z');
  await until('undone', async () => !(await textOf(studio, 'left')).includes('speed = 7'));
});

test('constants and events: added, renamed, removed, sent', two, async (studio) => {
  const { page, press, button } = studio;
  const row = (/** @type {string} */ name) =>
    page.getByRole('listitem').filter({ has: button(`Change ${name}`) });
  await open(studio);
  await button('Add a constant').click();
  await page.getByLabel('Name', { exact: true }).fill('FAR');
  await page.getByLabel('Value').fill('7');
  await press('Enter');
  await seen(button('Change FAR'));
  await row('FAR').hover();
  await button('Change FAR').click();
  await page.getByLabel('Name', { exact: true }).fill('AWAY');
  await press('Enter');
  await seen(button('Change AWAY'));
  await row('AWAY').hover();
  await button('Delete AWAY').click();
  await gone(button('Change AWAY'));
  await button('Add an event').click();
  await page.getByLabel('Name', { exact: true }).fill('ring');
  await page.getByLabel('Arguments').fill('1');
  await press('Enter');
  await row('ring').hover();
  await button('Send ring').click();
  await page.getByLabel('Arguments, separated by spaces').fill('42');
  await press('Enter');
  await seen(page.getByRole('list', { name: /What happened/ }).getByText(/ring/));
  await seen(page.getByRole('list', { name: /What happened/ }).getByText(/42/));
});
