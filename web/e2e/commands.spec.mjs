// Whatever a menu or a key offers does something, or says why not: tried with real keys.
import assert from 'node:assert/strict';
import { focused, gone, reads, seen, test, until } from './support/studio.mjs';
/** @import { Page } from './support/studio.mjs' */

const example = { words: ['--example', 'follow-wall'] };
const isLong = process.env['VAGUS_LONG'] !== undefined;
const kinds = ['Script', 'Plan', 'World', 'Toolbox', 'Text', 'Folder'];
const endings = ['aesl', 'plan.json', 'world.json', 'toolbox.json', 'txt', null];
// A toolbox brings a script of its name along.
const file = (/** @type {number} */ index) =>
  [`new${index}`, endings[index]].filter(Boolean).join('.');

/** The field of the name has the focus, and still has it after a menu would have given it back. */
async function named(/** @type {Page} */ page) {
  const field = page.getByRole('textbox', { name: 'Name of the new file' });
  await until('the field of the name has the focus', () =>
    field.evaluate((/** @type {any} */ one) => one === document.activeElement),
  );
  await page.evaluate(
    () => new Promise((done) => setTimeout(() => requestAnimationFrame(done), 60)),
  );
  assert.ok(await field.isVisible(), 'the field ended by itself');
  return field;
}

/** Ends what it ran in, or draws what cannot be read back from its canvas (3D); other tests do these. */
const ends = [
  'World: in 3D or from above',
  'Close the project',
  'Disconnect',
  'Open a folder…',
  'New project…',
  // It opens what it has written: what others do to a script is not seen behind that.
  'Keep the run as a test',
];
/** Nothing is seen of these as long as nothing changed. */
const quiet = [
  ...[
    'Save',
    'Save all',
    'Revert to the saved file',
    'Stop the robot',
    'Export the project as zip',
  ],
  ...[
    'World: clear trails',
    'World: list of things',
    'World: zoom out',
    'Change the theme: system, dark, light',
  ],
  ...[
    'Next panel',
    'Previous panel',
    // The command before them shows that panel, whose field may have the focus by then.
    'Watch a variable',
    'Find a variable',
    'Simulation back to its start',
    'Plan: copy the selection',
    'World: fit into the view',
    'Plan: fit it into the window',
  ],
];

/** What a person could notice: texts, states, where the focus is. */
const seenNow = (/** @type {Page} */ page) =>
  page.evaluate(() => {
    const { activeElement: focus } = document;
    const states = [
      ...document.querySelectorAll(
        '[aria-selected="true"], [aria-checked="true"], [aria-pressed="true"], .is-on, .react-flow__viewport, canvas, input',
      ),
    ];
    return [
      document.body.innerText,
      document.body.querySelectorAll('*').length,
      document.documentElement.dataset.theme,
      focus &&
        focus.tagName + focus.id + focus.className + (focus.getAttribute('aria-label') ?? ''),
      ...states.map(
        (one) =>
          one.className +
          (one.getAttribute('style') ?? '') +
          (one instanceof HTMLInputElement ? one.value : '') +
          (one.textContent ?? '').slice(0, 40),
      ),
      ...[...document.querySelectorAll('canvas')].map((one) => {
        const drawn = one.getContext('2d');
        if (!drawn || one.width * one.height === 0) return '';
        // Not toDataURL: to pack the picture took longer than all else that is asked here.
        const pixels = new Uint32Array(drawn.getImageData(0, 0, one.width, one.height).data.buffer);
        return pixels.reduce((sum, pixel) => (Math.imul(sum, 31) + pixel) | 0, 7);
      }),
    ].join('\n');
  });

const inside = (/** @type {Page} */ page, /** @type {string} */ tab) =>
  until(`the focus is in ${tab}`, () =>
    page.evaluate(
      (/** @type {string} */ id) =>
        document.activeElement?.closest('[data-tab-content]')?.getAttribute('data-tab-content') ===
        id,
      tab,
    ),
  );

for (const by of ['mouse', 'keyboard'])
  test(`+ of the project's tree makes every kind of file, by ${by}`, example, async (studio) => {
    const { page, press, type, button } = studio;
    await studio.layout('Script');
    const plus = button('New file or folder');
    for (const [index, kind] of kinds.entries()) {
      const item = page.getByRole('menuitem', { name: kind, exact: true });
      if (by === 'mouse') {
        await plus.click();
        await item.click();
      } else {
        await plus.focus();
        await press('Enter');
        await seen(page.getByRole('menu'));
        await until('the entry has the focus', async () => {
          if (await item.evaluate((one) => one === document.activeElement)) return true;
          await press('ArrowDown');
        });
        await press('Enter');
      }
      await named(page);
      await press('Control+a');
      await type(file(index));
      await press('Enter');
      await seen(page.locator(`[role="treeitem"][data-path="${file(index)}"]`));
      // It is shown, and has the focus, before something else is asked for.
      if (endings[index]) await inside(page, `doc:${file(index)}`);
    }
  });

test('after a click in the tree F2 and Delete mean the file', example, async (studio) => {
  const { page, press, type, button } = studio;
  await studio.layout('Draw');
  const actor = page.getByRole('group', { name: /^followWall, actor/ });
  await actor.click();
  await studio.tab('Project').click();
  const row = page.getByRole('treeitem', { name: 'WallFollow.plan' });
  await row.click();
  await press('Delete');
  await seen(button('Cancel'));
  await press('Escape');
  await seen(actor);
  await row.click();
  await press('F2');
  await focused(page.getByRole('textbox', { name: 'Rename' }));
  await type('Walls');
  // Elsewhere is as good as Enter.
  await studio.tab('Palette').click();
  await seen(studio.tab(/^Walls\.plan/));
});

test(
  'Ctrl+K over an open menu leaves the keyboard alive',
  example,
  async ({ page, press, button, type, layout }) => {
    await layout('Script');
    await button('New file or folder').click();
    await seen(page.getByRole('menu'));
    await press('ArrowDown', 'Control+k');
    const field = page.getByRole('combobox', { name: 'Type a command' });
    await until('the palette has the focus', () =>
      field.evaluate((one) => one === document.activeElement),
    );
    await page.getByRole('menu').waitFor({ state: 'hidden' });
    await type('Keys');
    await press('Enter');
    await seen(page.getByRole('dialog', { name: 'Keys' }));
    await press('Escape');
    await press('Control+k');
    await seen(field);
    await press('Escape');
  },
);

test(
  'Alt+Shift+U in the editor uploads its script',
  { words: ['--example', 'thymio'] },
  async (studio) => {
    const { page, press, button, layout } = studio;
    await layout('Script');
    await press('F5');
    await seen(button(/Running/));
    await page.getByRole('textbox', { name: /^Script of/ }).click();
    await press('Alt+Shift+u');
    await seen(page.getByText(/ is on the robot\.$/));
  },
);

test('a key that can do nothing now says why', example, async (studio) => {
  const { page, press, type, command, editor } = studio;
  await seen(page.getByRole('region', { name: /drawn$/ }));
  await press('F8');
  await reads(page.getByRole('log', { name: 'Messages' }), /Pause: Nothing is running\./);
  // What a command says is about what is in front.
  const why = async (/** @type {string} */ title) => {
    await press('Control+k');
    await type(title);
    const row = page.locator('.palette__item').filter({ hasText: title }).first();
    const said = await row.locator('.palette__why').allInnerTexts();
    await press('Escape');
    return said.join();
  };
  // By the list of commands, as by a click: the menu of the clock, which gives the keyboard back.
  const clock = page.getByRole('button', { name: /Speed of the clock/ });
  await clock.focus();
  await command('Speed of the clock…');
  await focused(page.getByRole('menu'));
  await press('ArrowDown', 'Enter');
  await reads(clock, /0\.1×/);
  await focused(clock);
  assert.equal(await why('Next difference'), 'Compare the plan with another version first.');
  await page.getByRole('region', { name: /drawn$/ }).focus();
  await command('Layout Script');
  await focused(editor('drive'));
  assert.equal(await why('Breakpoint on this line'), '');
  await page.getByRole('treeitem', { name: 'hall.world' }).dblclick();
  const mode = (/** @type {string} */ name) => page.getByRole('radio', { name, exact: true });
  await mode('Edit').focus();
  await press('ArrowLeft');
  await focused(mode('Live'));
  assert.match(await why('World: add a Carbot'), /choose Edit first/);
  await focused(mode('Live'));
  // Arrows go on from mode to mode, and commands are for the one that is shown.
  await press('ArrowRight');
  await focused(mode('Edit'));
  assert.equal(await why('World: add a Carbot'), '');
  assert.equal(await why('World: delete the selected thing'), 'Select a thing in the world first.');
});

test('the path of a file is copied', example, async ({ page, layout }) => {
  await layout('Script');
  const row = page.locator('[role="treeitem"][data-path="carbot/arena.world.json"]');
  const copy = async () => {
    await row.focus();
    await row.getByRole('button', { name: /More/ }).click();
    await page.getByRole('menuitem', { name: 'Copy the path' }).click();
    await seen(page.getByText('carbot/arena.world.json is on the clipboard.'));
  };
  await copy();
  assert.equal(
    await page.evaluate(() => navigator.clipboard.readText()),
    'carbot/arena.world.json',
  );
  // Without https there is no clipboard of the page.
  await page.getByRole('button', { name: 'Close' }).last().click();
  await page.evaluate(() =>
    Object.defineProperty(navigator, 'clipboard', { value: undefined, configurable: true }),
  );
  await copy();
});

test('a new token sends others away, and this page stays', example, async (studio) => {
  const { page, button, command, layout, context, server } = studio;
  await layout('Script');
  const other = await context.newPage();
  await other.goto(server.address);
  await seen(other.getByText(/View only/));
  await command('New token…');
  await button('Make a new token').click();
  const field = page.getByRole('textbox', { name: 'New address' });
  await seen(field);
  const address = await field.inputValue();
  assert.match(address, /#token=[0-9a-f]{32}$/);
  assert.notEqual(address, server.address);
  await seen(other.getByText(/^The studio does not let this page in\./));
  // This one has control still, also when it is loaded again.
  await button('Close').last().click();
  await page.reload();
  await layout('Draw');
  await seen(page.getByRole('region', { name: /drawn$/ }));
  await gone(page.getByText(/View only/));
  await other.goto(address);
  await other.reload();
  await seen(other.getByText(/View only/));
});

test(
  'keys with Alt, and F12, say why they do nothing now',
  example,
  async ({ page, press, layout, command }) => {
    await layout('Draw');
    const log = page.getByRole('log', { name: 'Messages' });
    await seen(page.getByRole('region', { name: /drawn$/ }));
    await press('F12');
    await reads(log, /Go to definition: Open a script first\./);
    await press('Alt+F12');
    await reads(log, /Plan: show the active actor: No actor is active\./);
    await command('Disconnect');
    await gone(page.getByRole('button', { name: /^State of the bus/ }));
    await press('Alt+Shift+u');
    await reads(log, /Upload to the node: No node is connected\./);
  },
);

/** Opens one menu after the other from its place, and reads its entries: [title, is off]. */
const menus = [
  {
    name: 'the tree',
    layout: 'Script',
    open: async (/** @type {any} */ { page }, /** @type {string} */ by) => {
      const row = page.locator('[role="treeitem"][data-path="carbot/arena.world.json"]');
      await row.focus();
      if (by === 'mouse') await row.getByRole('button', { name: /More/ }).click();
      else await page.keyboard.press('Shift+F10');
    },
  },
  {
    name: 'an element',
    layout: 'Draw',
    open: async (/** @type {any} */ { page, tab }, /** @type {string} */ by) => {
      // An entry may have shown the script instead.
      await tab(/^WallFollow/).click();
      const actor = page.getByRole('group', { name: /^followWall, actor/ });
      await actor.focus();
      await page.keyboard.press('Space');
      if (by === 'mouse') await actor.click({ button: 'right' });
      else await page.keyboard.press('Shift+F10');
    },
  },
  {
    name: 'the clock',
    layout: 'Script',
    // A run that is at its start cannot be seen to go back there.
    begin: async (/** @type {any} */ { page, press }) => {
      await press('F5');
      await reads(page.locator('button.clock'), /^(?!0\.0 s)[\d.]+ s\s+Running/);
      await press('F8');
      await reads(page.locator('button.clock'), /Paused/);
    },
    open: async (/** @type {any} */ { page }, /** @type {string} */ by) => {
      const clock = page.locator('button.clock');
      if (by === 'mouse') await clock.click();
      else {
        await clock.focus();
        await page.keyboard.press('Enter');
      }
    },
  },
];
/** Another window opens, or the run ends, or the same is seen as before. */
const unseen = /^(Simulation back to its start|1 ×|1x|.*✓)/;

for (const { name, layout, open, begin } of menus)
  for (const by of ['mouse', 'keyboard'])
    test(
      `every entry of the menu of ${name} does something or says why not, by ${by}`,
      example,
      async (studio) => {
        const { page, press } = studio;
        await studio.layout(layout);
        await begin?.(studio);
        const menu = page.getByRole('menu');
        const items = menu.getByRole('menuitem');
        // Keys are for the menu once it has the focus.
        const show = async () => {
          await open(studio, by);
          await focused(menu);
        };
        await show();
        const all = await items.evaluateAll((rows) =>
          rows.map((row) => ({
            title:
              row.querySelector('.mantine-Menu-itemLabel, [class*=itemLabel]')?.firstChild
                ?.textContent ??
              row.textContent ??
              '',
            off: row.hasAttribute('data-disabled') || row.hasAttribute('disabled'),
            why: row.querySelector('.menu__help')?.textContent ?? '',
          })),
        );
        await press('Escape');
        await gone(menu);
        assert.ok(all.length > 2, `${all.length} entries`);
        for (const { title, off, why } of all) assert.equal(off, why !== '', `${title}: ${why}`);
        const idle = [];
        for (const [index, { title, off }] of all.entries()) {
          if (off || unseen.test(title)) continue;
          // As it is without the menu: that it closes is nothing that the entry does.
          await show();
          await press('Escape');
          await gone(menu);
          const before = await seenNow(page);
          await show();
          const item = items.nth(index);
          if (by === 'mouse') await item.click();
          else {
            await until('the entry has the focus', async () => {
              if (await item.evaluate((one) => one === document.activeElement)) return true;
              await press('ArrowDown');
            });
            await press('Enter');
          }
          await gone(menu);
          const did = await until(title, async () => (await seenNow(page)) !== before, 5000).catch(
            () => false,
          );
          if (!did) idle.push(title);
          await press('Escape', 'Escape');
          // What was removed comes back, so that the next entry has its place.
          if (/^(Delete|Duplicate|Extract)/.test(title) && layout === 'Draw')
            await press('Control+z');
        }
        assert.deepEqual(idle, [], 'these did nothing that is seen');
      },
    );

for (const layout of isLong ? ['Draw', 'Script'] : ['Draw'])
  test(
    `every command of the palette does something or says why not, in ${layout}`,
    example,
    async (studio) => {
      const { page, press, layout: show } = studio;
      const field = page.getByRole('combobox', { name: 'Type a command' });
      const options = page.locator('.palette__item');
      const open = async (title = '') => {
        await press('Control+k');
        await field.fill(title);
      };
      await show(layout);
      await seen(
        page
          .getByRole('treeitem', { name: 'vagus.json' })
          .or(page.getByRole('region', { name: /drawn$/ })),
      );
      await open();
      await seen(options);
      const all = await options.evaluateAll((rows) =>
        rows.map((row) => ({
          title: row.firstElementChild?.textContent ?? '',
          off: row.getAttribute('aria-disabled') === 'true',
          why: row.querySelector('.palette__why')?.textContent ?? '',
        })),
      );
      await press('Escape');
      assert.ok(all.length > 120, `${all.length} commands`);
      for (const { title, off, why } of all) assert.equal(off, why !== '', `${title}: ${why}`);
      const idle = [];
      let downloads = 0;
      page.on('download', () => downloads++);
      for (const { title, off } of all) {
        if (off || ends.includes(title) || title.startsWith('Layout ')) continue;
        // At most four messages show: errors of the command before would keep a new one away.
        await page.locator('.toast button').evaluateAll((all) => {
          for (const one of all) if (one instanceof HTMLElement) one.click();
        });
        const before = await seenNow(page);
        const saved = downloads;
        await open(title);
        const chosen = page.locator('.palette__item[aria-selected="true"]');
        await chosen.filter({ hasText: title }).waitFor();
        await press('Enter');
        // One that cannot be run any more leaves the palette open, and says why.
        const answer = await until('the palette is closed, or says why not', async () => {
          if ((await field.count()) === 0) return 'closed';
          return (
            (await chosen.getAttribute('aria-disabled', { timeout: 500 })) === 'true' && 'says why'
          );
        });
        if (answer === 'says why') {
          await press('Escape');
          continue;
        }
        const does = async () => (await seenNow(page)) !== before || downloads !== saved;
        if (!quiet.includes(title) && !(await until(title, does, 5000).catch(() => false)))
          idle.push(title);
        await press('Escape', 'Escape');
      }
      assert.deepEqual(idle, [], 'these did nothing that is seen');
    },
  );

test(
  'a file is deleted once that is confirmed',
  example,
  async ({ page, press, layout, button }) => {
    await layout('Script');
    const row = page.locator('[role="treeitem"][data-path="carbot/arena.world.json"]');
    await row.focus();
    await press('Delete');
    await seen(page.getByText('Delete arena.world.json?'));
    await press('Escape');
    await seen(row);
    await row.focus();
    await press('Delete');
    await seen(button('Cancel'));
    await press('Enter');
    await row.waitFor({ state: 'detached' });
    await seen(page.getByText('arena.world.json was moved to .vagus/trash.'));
  },
);
