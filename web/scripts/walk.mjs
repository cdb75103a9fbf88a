// Walks through the studio by keyboard and mouse against the stand-in, and says what does not work.
import assert from 'node:assert/strict';
import { openStudio } from './browser.mjs';

const { page, server, problems, close } = await openStudio({});
const editor = page.getByRole('textbox', { name: 'Script of drive' });
const text = () => server.model.docs.get('carbot/carbot.aesl#1').text;
const until = async (what, check) => {
  for (let turn = 0; turn < 60; turn++) {
    if (await check()) return;
    await page.waitForTimeout(100);
  }
  assert.fail(what);
};
// The caret goes to where a word stands in the text, by keys.
const goTo = async (word, nth = 0) => {
  const starts = [...text().matchAll(new RegExp(`\\b${word}\\b`, 'g'))].map((one) => one.index);
  const before = text().slice(0, starts.at(nth)).split('\n');
  await page.keyboard.press('Control+Home');
  for (let line = 1; line < before.length; line++) await page.keyboard.press('ArrowDown');
  for (let column = 0; column < before.at(-1).length + 1; column++)
    await page.keyboard.press('ArrowRight');
  return `Ln ${before.length}, Col ${before.at(-1).length + 1}`;
};
const steps = {
  async 'typing reaches the server'() {
    await editor.click();
    await page.keyboard.press('Control+Home');
    await page.keyboard.type('# hello\n');
    await until('the text', () => text().startsWith('# hello\n'));
  },
  async 'undo reaches the server'() {
    for (let turn = 0; turn < 4 && text().startsWith('# h'); turn++) {
      await page.keyboard.press('Control+z');
      await page.waitForTimeout(300);
    }
    await until('the text', () => text().startsWith('# Obeys'));
  },
  async 'F9 sets and clears a breakpoint'() {
    await page.keyboard.press('Control+Home');
    for (let line = 0; line < 13; line++) await page.keyboard.press('ArrowDown');
    await page.keyboard.press('F9');
    await until('a breakpoint', () => server.model.breakpoints.some((one) => one.line === 14));
    await page.keyboard.press('Control+F9');
    await page.getByLabel('Stops if').fill('token > 3');
    await page.keyboard.press('Enter');
    await until('a condition', () =>
      server.model.breakpoints.some((one) => one.condition === 'token > 3'),
    );
    await editor.click();
  },
  async 'F2 renames in all scripts'() {
    await page.keyboard.press('Control+Home');
    for (let line = 0; line < 9; line++) await page.keyboard.press('ArrowDown');
    for (let column = 0; column < 6; column++) await page.keyboard.press('ArrowRight');
    await page.keyboard.press('F2');
    await page.getByLabel('New name').fill('agreed');
    await page.keyboard.press('Enter');
    await until('the new name', () => text().includes('var agreed'));
    await until('it is shown', async () => (await editor.innerText()).includes('var agreed'));
  },
  async 'F12 goes to the definition'() {
    await editor.click();
    const declared = await goTo('agreed');
    await goTo('agreed', -1);
    await page.keyboard.press('F12');
    await page.getByText(declared).waitFor({ timeout: 5000 });
  },
  async 'Shift+F12 lists references'() {
    await page.keyboard.press('Shift+F12');
    await page.getByText('Where “agreed” is used').first().waitFor({ timeout: 5000 });
  },
  async 'a mistake is shown and Alt+Enter mends it'() {
    await editor.click();
    await page.keyboard.press('Control+End');
    await page.keyboard.type('\nonevent tick\nif token = 1 then');
    await page.locator('.diag').waitFor({ timeout: 5000 });
    await page.keyboard.press('Alt+Enter');
    await until('mended', () => text().includes('if token == 1 then'));
    await page.locator('.diag').waitFor({ state: 'detached', timeout: 5000 });
  },
  async 'Ctrl+S saves'() {
    await page.keyboard.press('Control+s');
    await until('saved', () => server.model.docs.get('carbot/carbot.aesl#1').saved === text());
  },
  async 'F6 goes round all panels'() {
    const seen = new Set();
    for (let turn = 0; turn < 9; turn++) {
      await page.keyboard.press('F6');
      seen.add(
        await page.evaluate(
          () =>
            document.activeElement
              ?.closest('[data-region], [data-tab-content], .flexlayout__tabset_container')
              ?.getAttribute('data-region') ??
            document.activeElement
              ?.closest('[data-tab-content]')
              ?.getAttribute('data-tab-content') ??
            document.activeElement?.getAttribute('aria-label'),
        ),
      );
    }
    console.log('   ', [...seen].join(' | '));
    assert.ok(seen.size >= 5);
  },
  async 'the tree: F2 renames a file, arrows move'() {
    await page.getByRole('treeitem', { name: /vagus.json/ }).focus();
    await page.keyboard.press('F2');
    await page.getByLabel('Rename').fill('vagus2.json');
    await page.keyboard.press('Enter');
    await page.getByRole('treeitem', { name: /vagus2.json/ }).waitFor({ timeout: 5000 });
  },
  async 'a new file by the palette'() {
    await page.keyboard.press('Control+k');
    await page.keyboard.type('new text');
    await page.keyboard.press('Enter');
    await page.getByLabel('Name of the new file').fill('notes.txt');
    await page.keyboard.press('Enter');
    await page.getByRole('treeitem', { name: /notes.txt/ }).waitFor({ timeout: 5000 });
    await page.getByRole('tab', { name: /notes.txt/ }).waitFor({ timeout: 5000 });
  },
  async 'zip export'() {
    const [download] = await Promise.all([
      page.waitForEvent('download', { timeout: 8000 }),
      page
        .getByRole('button', { name: /^Project:/ })
        .click()
        .then(() => page.getByRole('menuitem', { name: /Export/ }).click()),
    ]);
    assert.equal(download.suggestedFilename(), 'follow-wall.zip');
  },
  async 'an event is added'() {
    await page.getByRole('button', { name: 'Add an event' }).click();
    await page.getByLabel('Name', { exact: true }).fill('hello.there');
    await page.keyboard.press('Enter');
    await until('the event', () => server.model.events.some((one) => one.name === 'hello.there'));
  },
  async 'run, pause, stop by keys'() {
    await page.keyboard.press('F5');
    await until('runs', () => server.model.clock.state === 'running');
    await page.getByText('Running').waitFor({ timeout: 5000 });
    await page.keyboard.press('F8');
    await until('paused', () => server.model.clock.state === 'paused');
    await page.keyboard.press('Shift+F5');
    await until('stopped', () => server.model.clock.state === 'none');
  },
  async 'the layout is kept over a reload'() {
    await page.getByRole('radio', { name: 'Debug' }).click();
    await page.getByRole('tab', { name: 'Breakpoints' }).waitFor();
    await page.waitForTimeout(600);
    await page.reload();
    await page.getByRole('radio', { name: 'Debug', checked: true }).waitFor({ timeout: 8000 });
  },
  async 'a lost connection says so, and comes back'() {
    for (const socket of server.sockets()) socket.terminate();
    await page.getByText(/does not answer since/).waitFor({ timeout: 5000 });
    await page.getByText(/does not answer since/).waitFor({ state: 'detached', timeout: 8000 });
  },
};
let failed = 0;
for (const [name, step] of Object.entries(steps)) {
  try {
    await step();
    console.log('ok ', name);
  } catch (error) {
    failed++;
    console.log('BAD', name, '-', String(error).split('\n')[0].slice(0, 200));
    await page.screenshot({ path: `shots/walk-${failed}.png` });
    await page.keyboard.press('Escape');
  }
}
for (const problem of problems) console.log('console:', problem);
await close();
process.exit(failed);
