// Another layout shows the same documents.
import assert from 'node:assert/strict';
import { makeProject } from './support/robots.mjs';
import { gone, seen, test, until } from './support/studio.mjs';
/** @import { TestContext } from './support/studio.mjs' */

const prepare = (/** @type {TestContext} */ t) =>
  makeProject(
    t,
    { name: 'L', plan: 'P.plan.json' },
    {
      'P.plan.json': '{ "format": "vagus-plan/1", "name": "P", "actors": {} }\n',
      'notes.txt': 'remember\n',
    },
  );

test(
  'a document opened in one layout is open in the others until it is closed',
  { prepare },
  async (studio) => {
    const { page, layout, tab } = studio;
    await layout('Script');
    await page.getByRole('treeitem', { name: /^notes/ }).dblclick();
    const notes = tab(/^notes/);
    await seen(notes);
    for (const name of ['Draw', 'Debug', 'Script', 'Draw']) {
      await layout(name);
      await seen(notes);
    }
    // Draw goes on showing its plan.
    assert.equal(await tab(/^P\.plan/).getAttribute('aria-selected'), 'true');
    await notes.hover();
    await notes.locator('.flexlayout__tab_button_trailing').click();
    await gone(notes);
    for (const name of ['Debug', 'Script']) {
      await layout(name);
      await seen(page.getByRole('radio', { name, checked: true }));
      await gone(notes);
    }
  },
);

test(
  'a window that becomes small, and large again, keeps its documents',
  { prepare },
  async (studio) => {
    const { page, layout, tab } = studio;
    await layout('Draw');
    await page.getByRole('tab', { name: 'Project' }).click();
    await page.getByRole('treeitem', { name: /^notes/ }).dblclick();
    await seen(tab(/^notes/));
    // Palette and Properties share a column, and are no longer on both sides.
    const shown = page.getByRole('tab', { name: /^(Palette|Project|Properties)/, selected: true });
    await until('two columns of panels', async () => (await shown.count()) === 2);
    await page.setViewportSize({ width: 720, height: 450 });
    await until('one column of panels', async () => (await shown.count()) === 1);
    await seen(tab(/^notes/));
    await page.setViewportSize({ width: 1440, height: 900 });
    await until('two columns again', async () => (await shown.count()) === 2);
    await seen(tab(/^notes/));
  },
);

test(
  'a document opened just before the page is loaded again is open after it',
  { prepare },
  async (studio) => {
    const { page, layout, tab } = studio;
    await layout('Script');
    for (let times = 0; times < 3; ++times) {
      await page.getByRole('treeitem', { name: /^notes/ }).dblclick();
      await seen(tab(/^notes/));
      await page.reload();
      await seen(tab(/^notes/));
      await tab(/^notes/).hover();
      await tab(/^notes/)
        .locator('.flexlayout__tab_button_trailing')
        .click();
      await gone(tab(/^notes/));
      await page.reload();
      await seen(page.getByRole('treeitem', { name: /^notes/ }));
      assert.equal(await tab(/^notes/).count(), 0);
    }
  },
);
