// Work that is never lost: a server that is started again or does not answer, two pages, files that
// change on disk or get another name, keyboards of other countries.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { makeProject, twoNodes } from './support/robots.mjs';
import { restarted } from './support/server.mjs';
import { hands, openWindow, reads, seen, test, until } from './support/studio.mjs';
/** @import { Locator, Page, Studio, TestContext } from './support/studio.mjs' */

const scripts = { left: 'var left = 0\n', right: 'var right = 0\n' };
const two = { prepare: (/** @type {TestContext} */ t) => twoNodes(t, scripts, {}) };
const textOf = async (/** @type {Studio} */ { editor }, /** @type {string} */ node) =>
  (await editor(node).innerText()).replaceAll('\u200b', '').replaceAll('\n\n', '\n');
const says = (
  /** @type {Studio} */ studio,
  /** @type {string} */ node,
  /** @type {string} */ what,
) => until(`${node} says ${what}`, async () => (await textOf(studio, node)).includes(what));

async function typeAtEnd(
  /** @type {Studio} */ studio,
  /** @type {string} */ node,
  /** @type {string} */ what,
) {
  await studio.tab(new RegExp(`^${node}`)).click();
  await studio.editor(node).click();
  await studio.press('Control+End');
  await studio.type(what);
}

const plan = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(
      t,
      { name: 'P', plan: 'p.plan.json' },
      {
        'p.plan.json':
          '{ "format": "vagus-plan/1",\r\n"name": "P", "start": {}, "actors": {} }\r\n',
      },
    ),
};

test('what is typed while the server is started again is there afterwards', two, async (studio) => {
  const { page } = studio;
  await typeAtEnd(studio, 'left', '# before\n');
  await seen(page.getByText('Not saved'));
  await restarted(studio, () => studio.type('# meanwhile\n'));
  await until('both are there once', async () => {
    const text = await textOf(studio, 'left');
    return text.split('# before').length === 2 && text.split('# meanwhile').length === 2;
  });
  // Complaints about the connection are its own.
  studio.complaints.length = 0;
});

test('who had control has it again after a restart', two, async (studio) => {
  await typeAtEnd(studio, 'left', '# one\n');
  const other = await openWindow(studio.t, studio.server);
  await seen(other.button('Request control'));
  await restarted(studio, () => studio.type('# two\n'));
  await seen(other.page.getByText('What was typed is back'));
  await studio.type('# three\n');
  await until('what is typed arrives', async () =>
    (await textOf(other, 'left')).includes('# three'),
  );
  await seen(other.button('Request control'));
  studio.complaints.length = 0;
});

test(
  'a run that ended with the server is told, and is there to be opened',
  { words: ['--example', 'follow-wall'] },
  async (studio) => {
    const { page, press, button } = studio;
    await studio.layout('Draw');
    await press('F5');
    await seen(button(/Running: WallFollow/));
    // The last second may be lost.
    await until('some of it is on disk', async () => {
      const time = await page.locator('.clock__time').innerText();
      return parseFloat(time) > 1.5;
    });
    await restarted(studio);
    await seen(page.getByText(/the run ended with it/));
    await studio.tab('Timeline').click();
    await button('Open a run before this one').click();
    await page.getByRole('menuitem', { name: /^Run \d+, until/ }).click();
    // Its end may have been recorded, too, and then the actor is not active any more.
    await reads(page.locator('.clock'), /^(?!0\.000)[^]*Paused/);
    await reads(page.getByRole('group', { name: /^searchFirstWall, actor/ }), /×1/);
    studio.complaints.length = 0;
  },
);

test('a link that is frozen says so, and what was typed goes on', two, async (studio) => {
  const { child } = studio.server.program;
  await typeAtEnd(studio, 'left', '# one\n');
  child.kill('SIGSTOP');
  try {
    await studio.type('# two\n');
    await seen(studio.page.getByText('Not saved'));
  } finally {
    child.kill('SIGCONT');
  }
  await studio.press('Control+s');
  await seen(studio.page.getByText('Saved', { exact: true }));
  const other = await openWindow(studio.t, studio.server);
  await says(other, 'left', '# two');
});

test('two pages write one script, and each undoes its own', two, async (studio) => {
  const other = await openWindow(studio.t, studio.server);
  await typeAtEnd(studio, 'left', '# mine\n');
  await says(other, 'left', '# mine');
  await until('mine is gone', async () => {
    await studio.press('Control+z');
    return !(await textOf(studio, 'left')).includes('#');
  });
  await until('for both', async () => !(await textOf(other, 'left')).includes('#'));
});

test(
  'undo of the drawing survives layouts and letters in the text beside',
  plan,
  async (studio) => {
    const { page, command, press } = studio;
    const canvas = page.locator('[data-place~="plan"]').first();
    await canvas.waitFor();
    await command('Plan: new variable');
    const said = () => page.locator('.plan__text .cm-content').first();
    await page.getByRole('switch', { name: 'Text' }).click();
    await until('it is there', async () => (await said().innerText()).includes('configuration'));
    await studio.layout('Script');
    await studio.layout('Draw');
    await canvas.waitFor();
    await canvas.focus();
    await press('Control+z');
    await until('it is undone', async () => !(await said().innerText()).includes('configuration'));
  },
);

test('line ends stay as the file has them', plan, async (studio) => {
  const path = join(studio.place, 'p.plan.json');
  await studio.page.locator('[data-place~="plan"]').first().waitFor();
  await studio.command('Plan: new variable');
  await seen(studio.page.getByText('Not saved'));
  await studio.press('Control+s');
  await seen(studio.page.getByText('Saved', { exact: true }));
  const text = readFileSync(path, 'utf8');
  assert.ok(text.startsWith('{ "format": "vagus-plan/1",\r\n"name"'), text);
  assert.ok(text.endsWith('\r\n'), text);
});

test('a file that changes on disk is never overwritten', two, async (studio) => {
  const { page, button, press, place } = studio;
  const path = join(place, 'two.aesl');
  await typeAtEnd(studio, 'left', '# mine\n');
  await seen(page.getByText('Not saved'));
  writeFileSync(path, readFileSync(path, 'utf8').replace('var left = 0', 'var left = 7'));
  await press('Control+s');
  await says(studio, 'left', 'var left');
  await until('both, or a choice', async () => {
    const disk = readFileSync(path, 'utf8');
    return (
      (disk.includes('# mine') && disk.includes('= 7')) || (await button('Keep mine').isVisible())
    );
  });
  assert.ok(readFileSync(path, 'utf8').includes('= 7'));
});

test('a file that is no text any more is not offered in place of the text', two, async (studio) => {
  const { page, button, press, place } = studio;
  const path = join(place, 'two.aesl');
  const text = readFileSync(path, 'utf8');
  await studio.tab(/^left/).click();
  await seen(studio.editor('left'));
  writeFileSync(path, Buffer.from([0xff, 0x00]));
  const notice = page.getByRole('status').filter({ hasText: 'cannot be shown' });
  await seen(notice.getByText('is no text in UTF-8 any more'));
  assert.deepEqual(await notice.getByRole('button').allInnerTexts(), ['Keep mine']);
  await button('Keep mine').click();
  await notice.waitFor({ state: 'detached' });
  await studio.editor('left').click();
  await press('Control+s');
  await until('the text is on disk again', () => readFileSync(path, 'utf8') === text);
});

test('both are kept by one click where the file changed the same line', two, async (studio) => {
  const { page, button, press, place } = studio;
  const path = join(place, 'two.aesl');
  await studio.tab(/^left/).click();
  await studio.editor('left').click();
  await press('Control+Home');
  await press('End');
  await studio.type(' # mine');
  await seen(page.getByText('Not saved'));
  writeFileSync(path, readFileSync(path, 'utf8').replace('var left = 0', 'var left = 7'));
  await press('Control+s');
  await seen(page.getByText('The file changed on disk.'));
  await button('Show what changed').click();
  await seen(page.getByRole('textbox', { name: 'Use the file' }).getByText('var left = 7'));
  await seen(page.getByRole('textbox', { name: 'Keep mine' }).getByText('# mine'));
  await button('Keep both').click();
  await says(studio, 'left', 'var left = 0 # mine\nvar left = 7');
  await page.getByText('The file changed on disk.').waitFor({ state: 'detached' });
  await studio.editor('left').click();
  await press('Control+s');
  await until('both are on disk', () =>
    readFileSync(path, 'utf8').includes('var left = 0 # mine\nvar left = 7\n'),
  );
});

test('a tab that was duplicated stays connected beside the other', two, async (studio) => {
  const { page, context, server } = studio;
  await typeAtEnd(studio, 'left', '# first\n');
  // What a page opens begins with its session storage, as a duplicated tab does.
  const opened = context.waitForEvent('page');
  await page.evaluate(() => void window.open(location.href));
  const twin = /** @type {Studio} */ ({ page: await opened, server, ...hands(await opened) });
  await says(twin, 'left', '# first');
  const name = (/** @type {{ page: Page }} */ one) =>
    one.page.evaluate(() => sessionStorage.getItem('vagus.client'));
  await until('it has a name of its own', async () => (await name(twin)) !== (await name(studio)));
  /** @type {string[]} */
  const connections = [];
  for (const one of [page, twin.page])
    one.on('websocket', (socket) => connections.push(socket.url()));
  await typeAtEnd(studio, 'left', '# second\n');
  await says(twin, 'left', '# second');
  await twin.button('Request control').click();
  await studio.button('Release control').click();
  await twin.button('Request control').waitFor({ state: 'detached' });
  await typeAtEnd(twin, 'left', '# third\n');
  await says(studio, 'left', '# third');
  assert.deepEqual(connections, [], 'nobody was disconnected');
});

test(
  'a script that is renamed while it is open keeps its tab and its text',
  two,
  async (studio) => {
    const { page, place } = studio;
    await typeAtEnd(studio, 'left', '# typed\n');
    await seen(page.getByText('Not saved'));
    await studio.command('Show Project');
    await page
      .getByRole('treeitem', { name: /two\.aesl/ })
      .first()
      .focus();
    await studio.press('F2');
    await page.getByRole('textbox', { name: 'Rename' }).fill('other.aesl');
    await studio.press('Enter');
    await says(studio, 'left', '# typed');
    await studio.editor('left').click();
    await studio.press('Control+Home');
    await studio.type('# more\n');
    await studio.press('Control+s');
    await until('saved under its new name', () =>
      ['# typed', '# more'].every((one) =>
        readFileSync(join(place, 'other.aesl'), 'utf8').includes(one),
      ),
    );
    // What is done in the editor is done to the file of the new name.
    await studio.press('Control+f');
    await seen(page.locator('.cm-search'));
    await studio.press('Escape', 'F9');
    await seen(page.locator('.cm-breaks .disc[title^="Breakpoint on line 2"]'));
    await studio.editor('left').click();
    await studio.press('Control+End');
    await studio.type('le');
    await studio.press('Control+Space');
    await seen(page.getByRole('listbox').getByText('left'));
  },
);

test('a renamed variable is taken back before what was typed earlier', two, async (studio) => {
  const { page, press } = studio;
  await typeAtEnd(studio, 'left', '# typed\n');
  await press('Control+Home', 'ArrowRight', 'ArrowRight', 'ArrowRight', 'ArrowRight', 'F2');
  await page.getByLabel('New name').fill('speed');
  await press('Enter');
  await says(studio, 'left', 'var speed = 0');
  await studio.editor('left').click();
  await press('Control+z');
  await says(studio, 'left', 'var left = 0');
  assert.ok((await textOf(studio, 'left')).includes('# typed'));
});

test('what a person typed comes back after the file was used', two, async (studio) => {
  const { page, button, press, place } = studio;
  const path = join(place, 'two.aesl');
  await studio.tab(/^left/).click();
  await studio.editor('left').click();
  await press('Control+Home', 'End');
  await studio.type(' # mine');
  await seen(page.getByText('Not saved'));
  writeFileSync(path, readFileSync(path, 'utf8').replace('var left = 0', 'var left = 7'));
  await button('Use the file').click();
  await says(studio, 'left', 'var left = 7');
  await studio.editor('left').click();
  await press('Control+z');
  await says(studio, 'left', '# mine');
});

test('a text that only this page has is said to be', two, async (studio) => {
  const { page, place } = studio;
  await typeAtEnd(studio, 'left', '# saved\n');
  await studio.press('Control+s');
  await seen(page.getByText('Saved', { exact: true }));
  await restarted(studio, () => rmSync(join(place, 'two.aesl')));
  await seen(page.getByText('only this page has its text'));
  assert.ok((await textOf(studio, 'left')).includes('# saved'));
  // Complaints about the connection are its own.
  studio.complaints.length = 0;
});

test('a file that was deleted in the tree is saved again after a restart', two, async (studio) => {
  const { page, press, place, button } = studio;
  const path = join(place, 'two.aesl');
  await typeAtEnd(studio, 'left', '# typed\n');
  await press('Control+s');
  await seen(page.getByText('Saved', { exact: true }));
  await studio.command('Show Project');
  await page
    .getByRole('treeitem', { name: /two\.aesl/ })
    .first()
    .focus();
  await press('Delete');
  await seen(button('Cancel'));
  await press('Enter');
  await until('it is gone', () => !existsSync(path));
  await seen(page.getByText('Not on disk', { exact: true }));
  await restarted(studio);
  await seen(page.getByText('Not on disk', { exact: true }));
  await seen(page.getByText('Saving writes it again'));
  await studio.editor('left').click();
  // The page may save when it has control again.
  await until('it is there', async () => {
    await press('Control+s');
    return existsSync(path);
  });
  assert.ok(readFileSync(path, 'utf8').includes('# typed'));
  studio.complaints.length = 0;
});

test('a file that was deleted is said to be, and saving writes it again', two, async (studio) => {
  const { page, press, place } = studio;
  const path = join(place, 'two.aesl');
  await typeAtEnd(studio, 'left', '# typed\n');
  await press('Control+s');
  await seen(page.getByText('Saved', { exact: true }));
  rmSync(path);
  await seen(page.getByText('Not on disk', { exact: true }));
  await studio.editor('left').click();
  await press('Control+s');
  await until('it is there', () => existsSync(path));
  assert.ok(readFileSync(path, 'utf8').includes('# typed'));
  await seen(page.getByText('Saved', { exact: true }));
});

const odd = {
  prepare(/** @type {TestContext} */ t) {
    const made = makeProject(t, { name: 'O' }, { 'notes.txt': '' });
    writeFileSync(join(made.place, 'notes.txt'), Uint8Array.of(0xff, 0xfe));
    return made;
  },
};

test('a text that could not be opened is tried again', odd, async (studio) => {
  const { page, button, place } = studio;
  await seen(button('Project: O'));
  await studio.command('Show Project');
  await page.getByRole('treeitem', { name: /^notes/ }).dblclick();
  await seen(page.getByText('This text cannot be opened.'));
  // The server says so with a problem of its own.
  writeFileSync(join(place, 'notes.txt'), 'good\n');
  await button('Try again').click();
  await seen(page.getByRole('textbox', { name: /notes/ }).getByText('good'));
});

test('of a JSON file one of two is kept, chosen side by side', plan, async (studio) => {
  const { page, button, press, place } = studio;
  const path = join(place, 'p.plan.json');
  await page.locator('[data-place~="plan"]').first().waitFor();
  await studio.command('Plan: new variable');
  await seen(page.getByText('Not saved'));
  writeFileSync(path, readFileSync(path, 'utf8').replace('"start": {}', '"help": "disk"'));
  await press('Control+s');
  await seen(page.getByText('Both lines together are no JSON'));
  await seen(page.getByRole('textbox', { name: 'Use the file' }).getByText('disk'));
  await button('Keep mine').click();
  await press('Control+s');
  await until('mine is kept', () => readFileSync(path, 'utf8').includes('configuration'));
});

test('keys of a German, a Swiss and a French keyboard', plan, async (studio) => {
  const { page, command } = studio;
  const canvas = page.locator('[data-place~="plan"]').first();
  await canvas.waitFor();
  await command('Plan: new variable');
  await page.getByRole('switch', { name: 'Text' }).click();
  const said = () => page.locator('.plan__text .cm-content').first().innerText();
  const has = async () => (await said()).includes('configuration');
  await until('it is there', has);
  /** True: the key is left to be typed. */
  const keyIn = (/** @type {Locator} */ place, /** @type {any} */ init) =>
    place.evaluate(
      (element, init) =>
        element.dispatchEvent(
          new KeyboardEvent('keydown', { bubbles: true, cancelable: true, ...init }),
        ),
      init,
    );
  const key = (/** @type {any} */ init) => keyIn(canvas, init);
  // Ctrl+Shift+Z redoes, wherever Z is: nothing is to redo, and nothing is undone.
  await key({ key: 'Z', code: 'KeyY', ctrlKey: true, shiftKey: true });
  await key({ key: 'Z', code: 'KeyW', ctrlKey: true, shiftKey: true });
  await key({ key: 'y', code: 'KeyZ', ctrlKey: true });
  await key({ key: '€', code: 'KeyE', modifierAltGraph: true });
  assert.ok(await has());
  assert.ok(!(await page.evaluate(() => document.activeElement?.matches('input'))));
  await key({ key: 'z', code: 'KeyY', ctrlKey: true });
  await until('undone by its letter', async () => !(await has()));
  await key({ key: 'y', code: 'KeyZ', ctrlKey: true });
  await until('and redone', has);

  // The same in a text.
  const editor = page.locator('.plan__text .cm-content').first();
  await editor.click();
  await studio.press('Control+End');
  await studio.type('# typed');
  const typed = async () => (await said()).includes('# typed');
  await until('it is typed', typed);
  const caps = { modifierCapsLock: true, ctrlKey: true };
  await keyIn(editor, { key: 'z', code: 'KeyZ', keyCode: 90, shiftKey: true, ...caps });
  await keyIn(editor, { key: 'z', code: 'KeyY', keyCode: 90, shiftKey: true, ...caps });
  await keyIn(editor, { key: 'y', code: 'KeyZ', keyCode: 89, ctrlKey: true });
  assert.ok(await typed());
  await keyIn(editor, { key: 'Z', code: 'KeyY', keyCode: 90, ...caps });
  await until('undone by its letter, with Caps Lock', async () => !(await typed()));
  await keyIn(editor, { key: 'z', code: 'KeyY', keyCode: 90, shiftKey: true, ...caps });
  await until('redone', typed);
  assert.ok(await keyIn(editor, { key: '@', code: 'KeyQ', keyCode: 81, modifierAltGraph: true }));
  // As browsers on Windows that tell of AltGr as of Ctrl and Alt.
  const windows = { ctrlKey: true, altKey: true, modifierAltGraph: true };
  for (const [key, code, keyCode] of [
    ['[', 'Digit8', 56],
    [']', 'Digit9', 57],
    ['{', 'Digit7', 55],
    ['}', 'Digit0', 48],
    ['\\', 'Minus', 219],
    ['~', 'BracketRight', 187],
    ['|', 'IntlBackslash', 226],
  ])
    assert.ok(await keyIn(editor, { key, code, keyCode, ...windows }), `${key} is not typed`);
});
