// What axe finds serious, in each view and theme.
import { look } from './support/axe.mjs';
import { seen, test, until } from './support/studio.mjs';
/** @import { Studio } from './support/studio.mjs' */

for (const theme of /** @type {const} */ (['dark', 'light'])) {
  test(`the start screen, ${theme}`, { theme }, async (studio) => {
    const { page, press } = studio;
    await seen(page.getByRole('button', { name: /^Follow a wall/ }));
    await look(studio, 'start');
    await press('Alt+n');
    const made = page.getByRole('dialog', { name: 'New project' });
    await seen(made);
    await look(studio, 'new project', made);
    await press('Escape', 'Control+o');
    const opened = page.getByRole('dialog', { name: 'Open a folder' });
    await seen(opened);
    await look(studio, 'folder', opened);
  });

  test(
    `every layout and panel, ${theme}`,
    { theme, words: ['--example', 'follow-wall'] },
    async (studio) => {
      const { page, press, layout, command } = studio;
      // A project with a plan opens on its drawing.
      await seen(page.getByRole('radio', { name: 'Draw', checked: true }));
      await press('F5');
      await seen(page.getByRole('button', { name: /Running/ }));
      // What a run shows stays, and drawing it takes no time from looking at it.
      await press('F8');
      await seen(page.getByRole('button', { name: /Paused/ }));
      for (const name of ['Script', 'Draw', 'Debug', 'Present']) {
        await layout(name);
        await seen(page.getByRole('radio', { name, checked: true }));
        await until(
          'its panels are there',
          async () => (await page.getByRole('tabpanel').count()) > 1,
        );
        await look(studio, name);
      }
      await layout('Draw');
      await page.getByRole('group', { name: /^followWall, actor/ }).focus();
      await press('Space');
      await seen(page.getByRole('heading', { name: 'followWall' }));
      for (const shown of ['All data arrows', 'Text', 'What it does'])
        await page.getByRole('switch', { name: shown }).click();
      await look(studio, 'a plan with all that is beside it');
      await command('Show Timeline');
      await menu(studio, 'Open a run before this one');
      await layout('Script');
      await menu(studio, 'New file or folder');
      for (const panel of [
        'Palette',
        'Network',
        'Breakpoints',
        'Search',
        'Plots',
        'Console',
        'Watch',
        'Settings',
        'World',
      ]) {
        await command(`Show ${panel}`);
        const shown = page.getByRole('tabpanel', { name: panel });
        await seen(shown);
        await look(studio, panel, shown);
      }
      await press('Control+k');
      await seen(page.getByRole('combobox', { name: 'Type a command' }));
      await look(studio, 'palette', page.getByRole('dialog'));
      await press('Escape', 'F1');
      await seen(page.getByRole('option', { name: /^onevent/ }));
      await look(studio, 'help', page.getByRole('dialog'));
      await page.getByRole('tab', { name: 'Help', exact: true }).focus();
      await press('ArrowRight');
      const keys = page.getByRole('dialog', { name: 'Keys' });
      await seen(keys);
      await look(studio, 'keys', keys);
    },
  );
}

/** Open, as it is before a key chooses an item, and with one chosen. */
async function menu(/** @type {Studio} */ studio, /** @type {string} */ button) {
  const { page, press } = studio;
  await page.getByRole('button', { name: button }).click();
  const opened = page.getByRole('menu', { name: button });
  await seen(opened);
  await look(studio, `the menu “${button}”`, opened);
  await press('ArrowDown');
  await seen(opened.locator('[role=menuitem]:focus'));
  await look(studio, `the menu “${button}”, an item chosen`, opened);
  await press('Escape');
  await opened.waitFor({ state: 'hidden' });
}
