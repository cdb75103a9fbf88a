// Plans that are actors of other plans: added, fed, opened with a way back, made of chosen actors.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { makeProject } from './support/robots.mjs';
import { focused, gone, seen, test, until } from './support/studio.mjs';
/** @import { Page, TestContext } from './support/studio.mjs' */

const json = (/** @type {any} */ value) => `${JSON.stringify(value, null, 2)}\n`;
const inner = {
  format: 'vagus-plan/1',
  name: 'Nap',
  configuration: {
    long: { type: 'float', access: 'in', initial: 2, unit: 's' },
    slept: { type: 'float', access: 'out', initial: 0 },
  },
  start: { actor: 'wait' },
  actors: { wait: { template: 'Wait', in: { seconds: 'long' }, states: { Done: '@terminate' } } },
};
const outer = {
  format: 'vagus-plan/1',
  name: 'Day',
  configuration: { pause: { type: 'float', initial: 1 } },
  start: { actor: 'rise' },
  actors: {
    rise: { template: 'Log', in: { text: '"up"' }, states: { Done: 'rest' } },
    rest: { template: 'Wait', in: { seconds: 'pause' }, states: { Done: 'say' } },
    say: { template: 'Log', in: { text: 'pause' }, states: { Done: 'rise' } },
  },
};
const project = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(
      t,
      { name: 'Days', plan: 'Day.plan.json' },
      { 'Day.plan.json': json(outer), 'Nap.plan.json': json(inner) },
    ),
};
const element = (/** @type {Page} */ page, /** @type {string} */ name) =>
  page.getByRole('group', { name, exact: false });
const saved = (/** @type {string} */ place, /** @type {string} */ name) =>
  JSON.parse(readFileSync(join(place, name), 'utf8'));

test('a sub-plan is added, fed, opened, and left again', project, async (studio) => {
  const { page, layout, press, place } = studio;
  await layout('Draw');
  await seen(element(page, 'rise, actor Log'));
  await page.getByRole('button', { name: 'Nap.plan.json, sub-plan' }).click();
  const nap = element(page, 'nap, sub-plan Nap.plan.json');
  await seen(nap);
  await nap.focus();
  await press('Enter');
  const form = page.getByRole('region', { name: 'Properties' });
  // What its file declares: an input with a default and a unit, an output.
  await form.getByLabel('long').fill('pause * 3');
  await press('Enter');
  await form.getByRole('combobox', { name: 'slept' }).selectOption('pause');
  await press('Control+s');
  await until('it is saved', () => saved(place, 'Day.plan.json').actors.nap?.out !== undefined);
  assert.deepEqual(saved(place, 'Day.plan.json').actors.nap, {
    plan: 'Nap.plan.json',
    in: { long: 'pause * 3' },
    out: { slept: 'pause' },
  });
  await nap.focus();
  await press('o');
  await seen(page.getByRole('region', { name: 'Plan Nap, drawn' }));
  await page.getByRole('navigation', { name: 'Back to Day' }).getByRole('button').click();
  await seen(page.getByRole('region', { name: 'Plan Day, drawn' }));
});

test('chosen actors become a plan of their own, which does the same', project, async (studio) => {
  const { page, layout, press, place } = studio;
  await layout('Draw');
  await element(page, 'rest, actor').click();
  await element(page, 'say, actor').click({ modifiers: ['Control'] });
  await press('Control+Shift+e');
  await seen(element(page, 'rest, sub-plan Rest.plan.json'));
  await gone(element(page, 'say, actor'));
  await press('Control+s');
  const { actors } = await until('it is saved', () => {
    const now = saved(place, 'Day.plan.json');
    return now.actors.say === undefined && now;
  });
  assert.deepEqual(Object.keys(actors), ['rise', 'rest', 'restFailed']);
  assert.deepEqual(actors.rest, {
    plan: 'Rest.plan.json',
    states: { OK: 'rise', Interrupted: '@terminate', Error: 'restFailed' },
  });
  const { configuration, start, actors: inside } = saved(place, 'Rest.plan.json');
  assert.deepEqual(configuration, { pause: { type: 'float', access: 'shared' } });
  assert.deepEqual(start, { actor: 'rest' });
  assert.equal(inside.say.states.Done, '@terminate');
  // The actor that fails after an error inside is meant to have no way out.
  await seen(page.getByRole('button', { name: '1 warning' }));
});

test('what cannot be a sub-plan says why', project, async (studio) => {
  const { page, layout, press } = studio;
  await layout('Draw');
  await element(page, 'rise, actor').click();
  await element(page, 'say, actor').click({ modifiers: ['Control'] });
  await press('Control+Shift+e');
  await seen(page.getByText('Others lead to rise, say.', { exact: false }));
});

test('an arrow dropped on nothing makes what it shall lead to', project, async (studio) => {
  const { page, layout, press, type } = studio;
  await layout('Draw');
  const port = element(page, 'say, actor').getByRole('button', { name: /^Done leads to rise/ });
  await port.focus();
  await press('Enter');
  // What is typed narrows the list: the field has the keyboard.
  await focused(page.getByRole('textbox', { name: 'Actor or template' }));
  await type('WaitFor');
  await press('Enter');
  await seen(element(page, 'waitForever, actor WaitForever'));
  await page
    .getByRole('img', { name: 'say Done leads to waitForever', exact: true })
    .waitFor({ state: 'attached' });
});
