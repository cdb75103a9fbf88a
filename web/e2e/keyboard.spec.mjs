// Write a script, run, break, step, change a value, see it in the world: by keyboard alone.
import { reads, seen, test, until } from './support/studio.mjs';
/** @import { Page, Studio } from './support/studio.mjs' */

const script = `var count = 0
motor.left.target = 100
motor.right.target = 100
onevent prox
count = count + 1
motor.left.target = 100 + count / 10`;

test('a robot is programmed without a mouse', {}, async (studio) => {
  const { page, press, type, command, editor } = studio;
  // From the start screen to a project of one's own.
  await seen(page.getByRole('heading', { name: 'Start' }));
  await press('Alt+n');
  await seen(page.getByRole('dialog', { name: 'New project' }));
  await type('first');
  await press('Enter');

  // Write.
  await seen(editor('thymio-II'));
  await focusEditor(studio);
  await press('Control+a', 'Delete');
  for (const line of script.split('\n')) {
    await type(line);
    await press('Enter');
  }
  await until('every line is there', async () => {
    const lines = (await editor('thymio-II').innerText()).split('\n').map((line) => line.trim());
    return script.split('\n').every((line) => lines.some((shown) => shown.startsWith(line)));
  });
  await seen(page.getByRole('button', { name: 'No problems' }));
  await press('Control+s');
  await seen(page.getByRole('contentinfo', { name: 'State' }).getByText('Saved', { exact: true }));

  // Run.
  await press('F5');
  await seen(page.getByRole('button', { name: /Running/ }));

  // Break at line 5.
  await press('Control+Home', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'F9');
  await seen(page.getByText('thymio-II paused at line 5'));
  await seen(page.getByRole('button', { name: /Paused/ }));
  await reads(page.locator('.cm-values'), /count = \d+/);

  // Step.
  await press('F10');
  await seen(page.getByText('thymio-II paused at line 6'));

  // Change a value.
  await press('Alt+Shift+v');
  const filter = page.getByRole('searchbox', { name: 'Find in all nodes' });
  await until('the filter has the focus', () =>
    filter.evaluate((one) => one === document.activeElement),
  );
  await type('count');
  const row = page.getByRole('list', { name: 'Variables' }).getByRole('listitem');
  await until(
    'only count is listed',
    async () => (await row.filter({ hasText: 'count' }).count()) === 1 && (await row.count()) <= 3,
  );
  await until('the row of count has the focus', async () => {
    await press('ArrowDown');
    return page.evaluate(() => document.activeElement?.textContent?.startsWith('count') ?? false);
  });
  await press('Enter');
  await seen(page.getByRole('textbox', { name: 'Value of count' }));
  await press('Control+a');
  await type('3000');
  await press('Enter');
  await reads(row.filter({ hasText: 'count' }), /3000/);
  await press('F10');

  // Go on without the breakpoint, and see it in the world: the left wheel turns faster, so the robot turns right.
  await focusEditor(studio);
  await press('Control+Home', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'F9');
  await press('F5');
  await seen(page.getByRole('button', { name: /Running/ }));
  await command('Layout Present');
  await seen(page.getByRole('table', { name: 'Things' }));
  await until('the robot turns to the right', async () => (await angleOf(page, 'thymio')) < -20);
  await press('Shift+F5');
  await seen(page.getByRole('button', { name: /Stopped/ }));
});

async function focusEditor(/** @type {Studio} */ { press, editor }) {
  await until('the editor has the focus', async () => {
    await press('F6');
    return editor('thymio-II').evaluate((/** @type {any} */ one) => one === document.activeElement);
  });
}

async function angleOf(/** @type {Page} */ page, /** @type {string} */ name) {
  const row = page.getByRole('table', { name: 'Things' }).getByRole('row', { name });
  return Number(
    (await row.getByRole('cell').last().innerText()).replace('−', '-').replace('°', ''),
  );
}
