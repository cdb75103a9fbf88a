// A window of 720 x 450, which is also what a zoom of 200 % leaves of 1440 x 900: every control can be reached.
import assert from 'node:assert/strict';
import { focused, gone, seen, test, until } from './support/studio.mjs';
import { unreachable } from './support/reach.mjs';
/** @import { Page } from './support/studio.mjs' */

const small = { width: 720, height: 450 };
const zoomed = { ...small, scale: 2 };
const wall = ['--example', 'follow-wall'];
const kFloating = '.overlay, .menu, .flexlayout__popup_menu';
const kPanels = [
  ...['Project', 'Palette', 'Problems', 'Events', 'Timeline', 'Plots', 'Console', 'Search'],
  ...['References', 'Variables', 'Watch', 'World', 'Properties', 'Network', 'Breakpoints'],
];

/**
 * What has come up late is given time; what stays out of reach is named.
 * @param {Page} page
 * @param {string} what
 */
async function fits(page, what, within = 'body') {
  /** @type {string[]} */
  let cut = [];
  await until(`all controls can be reached: ${what}`, async () => {
    cut = await unreachable(page, within);
    return cut.length === 0;
  }).catch(() => assert.deepEqual(cut, [], what));
}

/** @param {Page} page */
const drawing = (page) => page.getByRole('region', { name: 'Plan WallFollow, drawn' });

test('the start screen and its dialogs', small, async ({ page, button, press }) => {
  await seen(page.getByRole('heading', { name: 'Take an example' }));
  await fits(page, 'start screen');
  await button(/^New/).click();
  await seen(page.getByRole('dialog'));
  await fits(page, 'new project', kFloating);
  await press('Escape', 'Control+o');
  await seen(page.getByRole('dialog'));
  await fits(page, 'a folder', kFloating);
});

for (const looks of [small, zoomed])
  test(
    `layouts, menus and dialogs, ${looks === zoomed ? '200 %' : '720 x 450'}`,
    { words: wall, ...looks },
    async ({ page, layout, button, press, command }) => {
      for (const name of ['Script', 'Debug', 'Present', 'Draw']) {
        await layout(name);
        await seen(page.getByRole('tab', { selected: true }));
        await fits(page, name);
      }
      await seen(drawing(page));
      for (const name of [/^Target/, /Speed of the clock/, /^Project:/, /^Export the drawing/]) {
        await button(name).click();
        await fits(page, String(name), kFloating);
        await focused(page.locator('.menu'));
        await press('Escape');
        await gone(page.locator('.menu'));
      }
      for (const key of ['Control+k', 'F1']) {
        await press(key);
        await seen(page.getByRole('dialog'));
        await fits(page, key, kFloating);
        await press('Escape');
        await gone(page.getByRole('dialog'));
      }
      await command('New template…');
      await seen(page.getByRole('dialog'));
      await fits(page, 'new template', kFloating);
      await press('Escape');
      await page.getByRole('group', { name: /^followWall, actor/ }).click({ button: 'right' });
      await seen(page.getByRole('menuitem', { name: /delete the selection/ }));
      await fits(page, 'menu of an actor', kFloating);
      await focused(page.locator('.menu'));
      await press('Escape');
      await gone(page.locator('.menu'));
    },
  );

test('every panel, and settings', { words: wall, ...small }, async (studio) => {
  const { page, layout, command } = studio;
  await layout('Draw');
  await seen(drawing(page));
  await page.getByRole('group', { name: /^followWall, actor/ }).click();
  for (const name of kPanels) {
    await command(`Show ${name}`);
    await seen(page.getByRole('tab', { name: new RegExp(`^${name}`), selected: true }));
    await fits(page, name);
  }
  await command('Settings');
  await seen(page.getByRole('heading', { name: 'Settings' }));
  await fits(page, 'settings');
});

test(
  'a plan with its text, its code and what it does',
  { words: wall, ...small },
  async (studio) => {
    const { page, layout } = studio;
    await layout('Draw');
    for (const name of ['Text', 'Code', 'What it does']) {
      const option = page.getByRole('switch', { name });
      if ((await option.getAttribute('aria-checked')) === 'false') await option.click();
      await fits(page, name);
      await option.click();
    }
  },
);

test('a script with mistakes and its forms', { words: wall, ...small }, async (studio) => {
  const { page, layout, press, type, command, editor } = studio;
  await layout('Script');
  await editor('drive').click();
  await press('Control+Home');
  await type('x = 1 +');
  await press('Escape');
  await seen(page.getByRole('note'));
  await fits(page, 'mistakes');
  // The first mistake opens Problems where they have a place of their own, not over the text.
  assert.equal(
    await page.getByRole('tab', { name: /^Problems/ }).getAttribute('aria-selected'),
    'false',
  );
  await press('Control+End');
  await command('Condition of the breakpoint…');
  await seen(page.getByLabel('Stops if'));
  await fits(page, 'condition of a breakpoint');
});

test('a world is edited', { words: ['--example', 'thymio'], ...small }, async (studio) => {
  const { page, layout, command } = studio;
  await layout('Draw');
  await page.getByRole('radio', { name: 'Edit' }).click();
  await fits(page, 'world');
  await command('World: list of things');
  await fits(page, 'list of things');
});

test('a run, and looking back at it', { words: wall, ...small }, async (studio) => {
  const { page, layout, press, button, command } = studio;
  await layout('Debug');
  await seen(drawing(page));
  await press('F5');
  await seen(button(/Running/));
  await fits(page, 'running');
  await press('F8');
  await seen(button(/^Continue/));
  await fits(page, 'paused');
  await command('20 ms back');
  await seen(page.getByRole('region', { name: 'Looking back' }));
  await fits(page, 'the past');
  await layout('Present');
  await seen(page.getByRole('button', { name: /^Why / }));
  await fits(page, 'the past, presented');
  // A plan that is tried comes in front of the panel that shares its place.
  await command('Show Timeline');
  await gone(drawing(page));
  await command('Try the plan by hand');
  await seen(page.getByRole('region', { name: 'Try' }));
  await focused(page.getByRole('region', { name: 'Try' }));
  await fits(page, 'tried');
});

test(
  'a finger reaches what is beside the line between two panels',
  { words: ['--example', 'thymio'], width: 844, height: 390, touch: true },
  async ({ page, layout }) => {
    await layout('Script');
    await seen(page.getByRole('button', { name: 'Plot side' }));
    await fits(page, 'a telephone held across');
  },
);

test(
  'the list of tabs without room names them, and shows one by the keyboard',
  { words: wall, ...small },
  async (studio) => {
    const { page, layout, press } = studio;
    await layout('Script');
    const more = page.getByRole('button', { name: 'More tabs' }).last();
    const entry = page.getByRole('menuitem', { name: 'Plots' });
    await more.focus();
    await press('Enter');
    await seen(entry.getByText('Plots'));
    await fits(page, 'more tabs', kFloating);
    await press('Escape');
    await gone(entry);
    // The button has the keyboard again.
    await press('Enter');
    await seen(entry);
    await page.keyboard.type('Plots');
    await press('Enter');
    await seen(page.getByText('Nothing plotted.'));
  },
);
