// The generated program beside the drawing: an element and its lines are chosen together.
import assert from 'node:assert/strict';
import { makeProject } from './support/robots.mjs';
import { gone, reads, seen, test, until } from './support/studio.mjs';
/** @import { Page, Studio, TestContext } from './support/studio.mjs' */

const kPlan = `{
  "format": "vagus-plan/1",
  "name": "P",
  "start": { "actor": "wait" },
  "actors": {
    "wait": {
      "template": "Wait", "in": { "seconds": 1 }, "states": { "Done": "log" },
      "supervisors": { "late": { "template": "Timeout", "in": { "seconds": 5 }, "events": { "Timeout": "log" } } }
    },
    "log": { "template": "Log", "in": { "text": "\\"hello\\"" }, "states": { "Done": "@terminate" } }
  }
}
`;
const plan = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(t, { name: 'C', plan: 'P.plan.json' }, { 'P.plan.json': kPlan }),
};
const element = (/** @type {Page} */ page, /** @type {string} */ name) =>
  page.getByRole('group', { name, exact: false });
const heading = (/** @type {Page} */ page, /** @type {string} */ name) =>
  page.getByRole('heading', { name, exact: true });

async function codeOf(/** @type {Studio} */ { page, layout }) {
  await layout('Draw');
  await seen(element(page, 'wait, actor Wait'));
  await page.getByRole('switch', { name: 'Code', exact: true }).click();
  const code = page.getByRole('textbox', { name: 'Generated code, read only' });
  await reads(code, /core::Wait wait\("wait", \{\.seconds = "1"\}\);/);
  return code;
}
const marked = async (/** @type {Page} */ page) =>
  (await page.locator('.cm-ofElement').allInnerTexts()).map((/** @type {any} */ line) =>
    line.trim(),
  );

test('an element marks its lines, a line chooses its element', plan, async (studio) => {
  const { page, press } = studio;
  const code = await codeOf(studio);
  await element(page, 'wait, actor Wait').focus();
  await press('Space');
  await until('its lines are marked', async () => (await marked(page)).length === 3);
  assert.deepEqual(await marked(page), [
    'core::Wait wait("wait", {.seconds = "1"});',
    '// wait',
    'plan.after(wait, core::Wait::Done, log);',
  ]);
  await code.getByText('plan.during(wait, late').click();
  await seen(heading(page, 'late'));
  // By the keyboard: the line above belongs to the actor.
  await press('ArrowUp');
  await seen(heading(page, 'wait'));
});

test('the code follows the plan, and says why there is none', plan, async (studio) => {
  const { page, press } = studio;
  const code = await codeOf(studio);
  await element(page, 'wait, actor Wait').focus();
  await press('Enter');
  const field = page.getByRole('region', { name: 'Properties' }).getByLabel('seconds');
  await field.fill('2 * 3');
  await press('Enter');
  await reads(code, /\{\.seconds = "2 \* 3"\}/);
  await field.fill('nothing');
  await press('Enter');
  const panel = page.getByRole('region', { name: 'Generated code' });
  await reads(panel, /A plan with errors has no code[^]*"nothing", which does not exist/);
  await gone(code);
  await field.fill('3');
  await press('Enter');
  await reads(code, /\{\.seconds = "3"\}/);
});
