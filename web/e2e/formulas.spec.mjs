// Formulas in the form of an element: completed at the caret, checked with each key, marked where
// they are.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { makeProject } from './support/robots.mjs';
import { gone, reads, seen, test, until } from './support/studio.mjs';
/** @import { Studio, TestContext } from './support/studio.mjs' */

const kPlan = `{
  "format": "vagus-plan/1",
  "name": "P",
  "configuration": {
    "speed": { "type": "float", "initial": 1, "unit": "cm/s" },
    "far": { "type": "bool", "initial": false }
  },
  "start": { "actor": "wait" },
  "actors": {
    "wait": { "template": "Wait", "in": { "seconds": "1" }, "states": { "Done": "@terminate" } }
  }
}
`;
const plan = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(t, { name: 'F', plan: 'P.plan.json' }, { 'P.plan.json': kPlan }),
};

const slip = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(
      t,
      { name: 'F', plan: 'P.plan.json' },
      { 'P.plan.json': kPlan.replace('@terminate', '@termnate') },
    ),
};

async function form(/** @type {Studio} */ studio) {
  const { page, layout, press } = studio;
  await layout('Draw');
  const wait = page.getByRole('group', { name: 'wait, actor Wait', exact: false });
  await wait.focus();
  await press('Enter');
  return page.getByRole('region', { name: 'Properties' });
}
const seconds = (/** @type {string} */ place) =>
  JSON.parse(readFileSync(join(place, 'P.plan.json'), 'utf8')).actors.wait.in.seconds;

test('a formula is completed by the keyboard', plan, async (studio) => {
  const { page, press, place } = studio;
  const field = (await form(studio)).getByRole('combobox', { name: 'seconds' });
  const list = page.getByRole('listbox', { name: 'Suggestions' });
  await field.fill('');
  await field.pressSequentially('sq');
  await seen(list.getByRole('option', { name: 'sqrt sqrt(x)' }));
  // Nothing is chosen yet: the keys still belong to the field.
  assert.equal(await list.getByRole('option', { selected: true }).count(), 0);
  await press('ArrowDown', 'Tab');
  await until('the function is written', async () => (await field.inputValue()) === 'sqrt()');
  await gone(list);
  // The caret is between the parentheses.
  await press('Control+Space');
  await seen(list.getByRole('option', { name: 'speed float, cm/s', selected: true }));
  await press('ArrowDown', 'ArrowUp', 'Enter');
  await until('the variable is written', async () => (await field.inputValue()) === 'sqrt(speed)');
  await press('Control+Space');
  await seen(list);
  await press('Escape');
  await gone(list);
  assert.equal(await field.inputValue(), 'sqrt(speed)');
  await press('Enter', 'Control+s');
  await until('it is saved', () => seconds(place) === 'sqrt(speed)');
});

test('what is wrong with a formula is said while it is typed', plan, async (studio) => {
  const { page, press, place, button } = studio;
  const properties = await form(studio);
  const field = properties.getByRole('combobox', { name: 'seconds' });
  await field.fill('sped * 2');
  await reads(
    properties,
    /the formula for "seconds" uses the variable "sped", which does not exist; did you mean "speed"\?/,
  );
  assert.equal(await field.getAttribute('aria-invalid'), 'true');
  // Nothing is in the file before it is entered.
  assert.equal(await button('Undo').isDisabled(), true);
  await field.fill('speed * 2');
  await gone(properties.getByText('does not exist'));
  assert.equal(await field.getAttribute('aria-invalid'), 'false');
  await field.fill('sped * 2');
  await press('Enter');
  await seen(page.getByRole('group', { name: 'wait, actor Wait, 1 error' }));
  await properties.getByRole('button', { name: 'Write "speed"' }).click();
  await gone(properties.getByText('does not exist'));
  await press('Control+s');
  await until('it is fixed', () => seconds(place) === 'speed * 2');
});

test('the place of a mistake is marked in its field and in the text', plan, async (studio) => {
  const { page, press } = studio;
  const field = (await form(studio)).getByRole('combobox', { name: 'seconds' });
  await field.focus();
  await press('Control+a');
  await field.pressSequentially('2 * sped');
  const marked = () =>
    field.evaluate((/** @type {any} */ one) => {
      const style = getComputedStyle(one);
      const [from, to] = ['--from', '--to'].map((name) => Number(style.getPropertyValue(name)));
      return style.backgroundImage === 'none' ? '' : one.value.slice(from, to);
    });
  await until('the name is marked', async () => (await marked()) === 'sped');
  await press('Enter');
  await page.getByRole('switch', { name: 'Text' }).click();
  await reads(page.locator('.cm-finding--error'), /^sped$/);
  await field.focus();
  await press('Control+a');
  await field.pressSequentially('2 * speed');
  await until('nothing is marked', async () => (await marked()) === '');
});

test('what is wrong with a state is at its row, with its fix', slip, async (studio) => {
  const states = (await form(studio)).getByRole('region', { name: 'States' });
  await reads(states, /leads to "@termnate", which does not exist/);
  await states.getByRole('button', { name: 'Write "@terminate"' }).click();
  await gone(states.getByText('does not exist'));
});
