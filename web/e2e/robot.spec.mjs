// Variables, events and plots of a robot that runs.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { twoNodes } from './support/robots.mjs';
import { gone, reads, seen, test, until } from './support/studio.mjs';
/** @import { Page, Studio, TestContext } from './support/studio.mjs' */

const scripts = {
  left: `var n = 0
var wave[8]
var slow = 0
timer.period = 50
onevent timer
n = n + 1
wave[n % 8] = n
emit tick [n, 7]`,
  right: `var heard = 0
onevent tick
heard = args[0]
`,
};
const two = {
  prepare: (/** @type {TestContext} */ t) =>
    twoNodes(t, scripts, { events: { tick: 2, quiet: 0 } }),
};

async function run(/** @type {Studio} */ studio) {
  await seen(studio.editor('left'));
  await studio.press('F5');
  await seen(
    studio.page.getByText(/left: running the script of/).or(studio.page.getByText('tick')),
  );
}
const variable = (/** @type {Page} */ page, /** @type {string} */ name) =>
  page
    .getByRole('list', { name: 'Variables' })
    .getByRole('listitem')
    .filter({ has: page.getByText(name, { exact: true }) });
const happened = (/** @type {Page} */ page) => page.getByRole('list', { name: /What happened/ });
const number = (/** @type {string} */ text) =>
  Number(/-?\d+/.exec(text.replaceAll('\n', ' '))?.[0]);

test('variables are live, found, changed in place, watched', two, async (studio) => {
  const { page, press, button } = studio;
  await run(studio);
  // No plan runs and there is no clock: the scripts are named.
  await seen(page.getByText('Running: left, right'));
  const value = () => variable(page, 'n').getByRole('button').first().innerText();
  const before = await until('it has a value', async () => number(await value()));
  await until('it counts', async () => number(await value()) > before + 3);
  await variable(page, 'slow').getByTitle('Change slow').click();
  await page.getByLabel('Value of slow').fill('77');
  await press('Enter');
  await reads(variable(page, 'slow').getByTitle('Change slow'), '77');
  // An array: folded as bars, unfolded by element.
  await button('Elements of wave').click();
  await seen(page.getByText('[7]', { exact: true }));
  // Hexadecimal.
  await button('Numbers: decimal').click();
  await reads(variable(page, 'slow').getByTitle('Change slow'), /0x0*4D/i);
  await button('Numbers: hexadecimal').click();
  // Watched, in a table of its own over all nodes.
  await variable(page, 'n').hover();
  await button('Watch n').click();
  await studio.tab('Watch').click();
  await page
    .getByRole('textbox', { name: 'node.variable' })
    .or(page.getByLabel('node.variable'))
    .first()
    .fill('right.heard');
  await press('Enter');
  const watch = page.getByRole('tabpanel', { name: 'Watch' });
  await seen(watch.getByText('heard'));
  await until('both count', async () => /\d{2,}/.test(await watch.innerText()));
});

test('events are listed, filtered, held, counted, saved, sent', two, async (studio) => {
  const { page, button } = studio;
  await run(studio);
  await seen(happened(page).getByText('tick'));
  await reads(
    happened(page).getByRole('listitem').filter({ hasText: 'tick' }).first(),
    /\d+\.\d{3}\s+left\s+tick\s*\[\d+, 7\]/,
  );
  await page.getByRole('searchbox', { name: /Filter/ }).fill('-tick');
  await gone(happened(page).getByText('tick'));
  await seen(happened(page).getByText(/loaded/));
  await page.getByRole('searchbox', { name: /Filter/ }).fill('');
  await button('Pause the list').click();
  await seen(page.getByText(/\d+ newer ones? not shown/));
  await button('Continue the list').click();
  const [saved] = await Promise.all([page.waitForEvent('download'), button('Save as CSV').click()]);
  const csv = readFileSync(await saved.path(), 'utf8');
  assert.match(csv, /tick/);
  assert.match(csv.split('\n')[0], /time/);
  await button('Counts').click();
  await seen(page.getByRole('row', { name: /^tick left \d+/ }));
  await button('Counts').click();
  await button('Send…').click();
  await page.getByLabel('Event', { exact: true }).selectOption('quiet');
  await button('Send')
    .and(page.getByText('Send', { exact: true }))
    .click();
  await seen(happened(page).getByText('quiet'));
});

test('any variable, element or argument is plotted with one click', two, async (studio) => {
  const { page, press, button } = studio;
  await run(studio);
  await button('Plot n').click();
  await seen(page.getByRole('img', { name: /Plot of .*n/ }));
  const curves = page.getByRole('list', { name: 'Curves' });
  await until('it has values', async () => /\d{2,}/.test(await curves.innerText()));
  await button('Elements of wave').click();
  await button('Plot wave[3]').click();
  await seen(curves.getByText('wave[3]'));
  await button('Counts').click();
  await button('Plot the arguments of tick').click();
  await seen(page.getByLabel(/Axis of .*tick/).first());
  await page.getByLabel(/Axis of .*wave\[3\]/).selectOption('2');
  await button('Pause the plot').click();
  await page.getByRole('img', { name: /Plot of/ }).focus();
  await press('ArrowLeft', 'ArrowLeft', '+');
  await button('As a table').click();
  await seen(page.getByRole('table', { name: /rows? in sight/ }));
  await button('As a table').click();
  await studio.command('Copy the plot as CSV');
  const csv = await page.evaluate(() => navigator.clipboard.readText());
  assert.match(csv.split('\n')[0], /n.*wave\[3\]/);
  assert.match(csv, /\n[\d.]+,\d+/);
  const [picture] = await Promise.all([
    page.waitForEvent('download'),
    studio.command('Save the plot as PNG'),
  ]);
  assert.equal(picture.suggestedFilename(), 'plot.png');
  assert.equal(
    readFileSync(await picture.path())
      .subarray(1, 4)
      .toString(),
    'PNG',
  );
});
