// Notes on the canvas of a plan: written in place, moved, drawn larger, removed, taken back.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { makeProject } from './support/robots.mjs';
import { boxOf, gone, seen, test, until } from './support/studio.mjs';
/** @import { Page, TestContext } from './support/studio.mjs' */

const kPlan = `{
  "format": "vagus-plan/1",
  "name": "P",
  "start": { "actor": "wait" },
  "actors": {
    "wait": { "template": "Wait", "in": { "seconds": 1 }, "states": { "Done": "@terminate" } }
  },
  "layout": { "@start": [80, 80], "wait": [240, 80] }
}
`;
const plan = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(t, { name: 'N', plan: 'P.plan.json' }, { 'P.plan.json': kPlan }),
};
const card = (/** @type {Page} */ page, /** @type {string} */ text) =>
  page.getByRole('group', { name: `Note: ${text}`, exact: true });
const file = (/** @type {string} */ place) => readFileSync(join(place, 'P.plan.json'), 'utf8');
const notes = (/** @type {string} */ place) => JSON.parse(file(place)).x?.notes ?? [];

test('a note is written, moved, resized and removed by the keyboard', plan, async (studio) => {
  const { page, layout, press, place } = studio;
  await layout('Draw');
  await page.getByRole('group', { name: 'wait, actor Wait', exact: false }).focus();
  await press('n');
  const field = page.getByRole('textbox', { name: 'Text of the note' }).first();
  await seen(field);
  await page.keyboard.type('Why it waits:');
  await press('Enter');
  await page.keyboard.type('the lamp is slow');
  await press('Control+Enter');
  const note = card(page, 'Why it waits:');
  await seen(note);
  await press('Control+s');
  const [first] = await until('it is saved', () => notes(place).length === 1 && notes(place));
  assert.equal(first.text, 'Why it waits:\nthe lamp is slow');
  assert.deepEqual(first.size, [192, 72]);
  await note.focus();
  await press('ArrowDown', 'Control+s');
  await until('it is moved by a step of the grid', () => notes(place)[0].at[1] === first.at[1] + 8);
  await note.focus();
  await press('F2');
  await seen(field);
  await press('Escape');
  const form = page.getByRole('region', { name: 'Properties' });
  await form.getByLabel('Width').fill('240');
  await note.focus();
  await press('Control+s');
  await until('it is wider', () => notes(place)[0].size[0] === 240);
  await note.focus();
  await press('Delete');
  await gone(note);
  await press('Control+z');
  await seen(note);
  for (let step = 0; step < 4; step++) await press('Control+z');
  await gone(page.getByRole('group', { name: /^Note/ }));
  await press('Control+s');
  await until('the file is as it was', () => file(place) === kPlan);
});

test('while a note is written, Save takes it and Stop stops', plan, async (studio) => {
  const { page, layout, press, type, place } = studio;
  await layout('Draw');
  await page.getByRole('group', { name: 'wait, actor Wait', exact: false }).focus();
  await press('n');
  const field = page.getByRole('textbox', { name: 'Text of the note' }).first();
  await seen(field);
  await type('kept');
  await press('Control+s');
  await until('it is saved', () => notes(place)[0]?.text === 'kept');
  await type(' too');
  await seen(page.getByText('Not saved'));
  const stopped = page.waitForRequest((request) => new URL(request.url()).pathname === '/stop');
  await press('Shift+F5');
  await stopped;
  // Undo is the field's own.
  await press('Control+a', 'Delete');
  await type('all');
  await press('Control+Enter');
  await seen(card(page, 'all'));
});

test('a name that cannot be stays in its field, marked', plan, async (studio) => {
  const { page, layout, press, type, place } = studio;
  await layout('Draw');
  await page.getByRole('group', { name: 'wait, actor Wait', exact: false }).click();
  await press('F2');
  const field = page
    .getByRole('region', { name: 'Properties' })
    .getByRole('textbox', { name: 'Name' });
  await seen(field);
  await press('Control+a');
  await type('1 no name');
  await press('Enter', 'Control+s');
  assert.equal(await field.inputValue(), '1 no name');
  assert.equal(await field.getAttribute('aria-invalid'), 'true');
  await seen(page.getByText('Not saved'));
  await press('Control+a');
  await type('rest');
  await press('Control+s');
  await until('it is saved without Enter', () => 'rest' in JSON.parse(file(place)).actors);
});

test('a note is written and enlarged by the mouse', plan, async (studio) => {
  const { page, layout, press, place, button } = studio;
  await layout('Draw');
  await button('New note').click();
  await page.keyboard.type('first');
  await page.getByRole('region', { name: 'Plan P, drawn' }).click({ position: { x: 10, y: 10 } });
  const note = card(page, 'first');
  await note.dblclick();
  await page.keyboard.type(' and last');
  await press('Control+Enter');
  const after = card(page, 'first and last');
  await seen(after);
  await after.click();
  const corner = await boxOf(after.locator('.pnote__corner'));
  await page.mouse.move(corner.x + 6, corner.y + 6);
  await page.mouse.down();
  await page.mouse.move(corner.x + 60, corner.y + 60, { steps: 4 });
  await page.mouse.up();
  await press('Control+s');
  const [saved] = await until('it is larger', () => notes(place)[0]?.size[1] > 72 && notes(place));
  assert.equal(saved.text, 'first and last');
  assert.equal(saved.size[0] % 8, 0);
});
