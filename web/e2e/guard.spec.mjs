// A fault of the page itself: it is told, and nothing that was typed is lost.
import assert from 'node:assert/strict';
import { makeProject } from './support/robots.mjs';
import { reads, seen, test, until } from './support/studio.mjs';
/** @import { TestContext } from './support/studio.mjs' */

const plan = {
  format: 'vagus-plan/1',
  name: 'P',
  start: { actor: 'one' },
  actors: { one: { template: 'Wait', in: { seconds: 1 }, states: { Done: '@terminate' } } },
};
const prepare = (/** @type {TestContext} */ t) =>
  makeProject(t, { name: 'G', plan: 'P.plan.json' }, { 'P.plan.json': JSON.stringify(plan) });

test(
  'a page that fails says what happened, sends what was typed, and loads again',
  { prepare },
  async (studio) => {
    const { page, press, type, layout, command, complaints } = studio;
    await layout('Draw');
    const actor = page.getByRole('group', { name: /^one, actor Wait/ });
    const field = page.getByRole('region', { name: 'Properties' }).getByLabel('seconds');
    // A part of the page that cannot be drawn, and that comes while somebody types.
    let come = () => {};
    const typed = new Promise((done) => (come = () => done(undefined)));
    await page.route('**/assets/new_template_sheet-*.js', async (route) => {
      await typed;
      await route.fulfill({
        contentType: 'text/javascript',
        body: "export default function Broken() { throw new Error('the sheet is broken'); }",
      });
    });
    await command('New template…');
    await actor.click();
    await press('Enter');
    await field.click();
    await press('Control+a');
    await type('7');
    assert.equal(await field.evaluate((one) => one === document.activeElement), true);
    come();
    const said = page.getByRole('alert');
    await seen(said.getByRole('heading', { name: 'This page has failed.' }));
    await reads(said.locator('pre'), 'the sheet is broken');
    await seen(said.getByRole('button', { name: /^Stop/ }));
    await until('the browser has complained of it', () => complaints.length > 0);
    assert.ok(
      complaints.every((one) => one.includes('the sheet is broken')),
      complaints.join(),
    );
    complaints.length = 0;
    await page.unroute('**/assets/new_template_sheet-*.js');
    await said.getByRole('button', { name: 'Reload page' }).click();
    await actor.click();
    await press('Enter');
    await until('what was typed is there', async () => (await field.inputValue()) === '7');
  },
);
