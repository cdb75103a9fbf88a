// A template of one's own: made from the palette by the keyboard, put into the plan, run as it is.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { focused, gone, reads, seen, test, until } from './support/studio.mjs';
/** @import { Page, Studio } from './support/studio.mjs' */

const element = (/** @type {Page} */ page, /** @type {string} */ name) =>
  page.getByRole('group', { name, exact: false });

/** The line where the author of a template goes on is in sight, with the caret. */
async function standsAtPlace(/** @type {Page} */ page) {
  const editor = page.getByRole('textbox', { name: /^Script of/ }).first();
  const place = editor.getByText('# The work begins here');
  await seen(place);
  await until('the line to fill in is in sight', () =>
    place.evaluate((line) => {
      const { top, bottom } = line.getBoundingClientRect();
      const frame = line.closest('.cm-scroller')?.getBoundingClientRect();
      return frame && top >= frame.top && bottom <= frame.bottom;
    }),
  );
  await focused(editor);
}

async function asked(/** @type {Studio} */ { page, layout, button, press }) {
  await layout('Draw');
  await seen(page.getByRole('button', { name: 'Wait, actor' }));
  await button('New template…').focus();
  await press('Enter');
  const form = page.getByRole('form', { name: 'New template…' });
  await seen(form);
  return form;
}

test(
  'an actor of one’s own is made and runs',
  { words: ['--example', 'follow-wall'] },
  async (studio) => {
    const { page, type, press, layout, server } = studio;
    const form = await asked(studio);
    await type('Wait');
    await seen(form.getByText('There is a template of that name already.'));
    assert.equal(await form.getByRole('button', { name: 'Create' }).isDisabled(), true);
    await press('Control+a');
    await type('2nd');
    await seen(form.getByText('Letters, digits and _ only, not beginning with a digit.'));
    await press('Control+a');
    await type('Blink');
    await press('Tab', 'Tab', 'Tab');
    await type('Blinks for a moment.');
    await press('Enter');
    await gone(form);
    // The script is open, with what was added to it.
    const editor = page.getByRole('textbox', { name: /^Script of/ }).first();
    await reads(editor, /var blink_token = 0|# The work begins here/);
    const folder = join(server.data, 'projects/follow-wall/follow-wall');
    await until('the toolbox is there', () => existsSync(join(folder, 'own.toolbox.json')));
    assert.deepEqual(JSON.parse(readFileSync(join(folder, 'vagus.json'), 'utf8')).toolboxes, [
      'own.toolbox.json',
    ]);
    await page.getByRole('tab', { name: /WallFollow/ }).click();
    await layout('Draw');
    const blink = element(page, 'blink, actor Blink');
    await seen(blink);
    // It becomes where the plan begins, and leads on to the plan that there was.
    await blink.getByRole('button', { name: /^Done leads nowhere/ }).focus();
    await press('Enter');
    await page.getByRole('menuitem', { name: 'searchFirstWall', exact: true }).click();
    await element(page, 'Start, leads to searchFirstWall')
      .getByRole('button', { name: /connect to/ })
      .focus();
    await press('Enter');
    await page.getByRole('menuitem', { name: 'blink', exact: true }).click();
    await seen(element(page, 'Start, leads to blink'));
    await seen(page.getByText('No problems.'));
    await press('F5');
    // It works for half a second, says so, and the plan goes on.
    await seen(page.locator('.pactor.is-active').filter({ hasText: 'blink' }));
    await seen(page.locator('.pactor.is-active').filter({ hasText: 'searchFirstWall' }));
    await press('Shift+F5');
  },
);

test(
  'a template is asked for from wherever one is, and its script is where it is filled in',
  { words: ['--example', 'follow-wall'] },
  async (studio) => {
    const { page, press, type, layout, command } = studio;
    await layout('Script');
    await command('New template…');
    const form = page.getByRole('form', { name: 'New template…' });
    await seen(form);
    await type('Purr');
    await press('Enter');
    await gone(form);
    await standsAtPlace(page);
  },
);

test(
  'a script that is not open opens where the template is filled in',
  { words: ['--example', 'follow-wall'] },
  async (studio) => {
    const { page, press, type, layout, command } = studio;
    await layout('Draw');
    await seen(page.getByRole('region', { name: 'Plan WallFollow, drawn' }));
    await gone(page.getByRole('tab', { name: /^drive/ }));
    await command('New template…');
    const form = page.getByRole('form', { name: 'New template…' });
    await seen(form);
    await type('Purr');
    await press('Enter');
    await gone(form);
    await standsAtPlace(page);
  },
);
