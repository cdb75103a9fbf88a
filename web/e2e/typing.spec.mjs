// Other keyboards: what an input method composes, and what the keys of Apple keyboards are called and do.
import assert from 'node:assert/strict';
import { boxOf, focused, gone, reads, seen, test, until } from './support/studio.mjs';

const wall = { words: ['--example', 'follow-wall'] };
const thymio = { words: ['--example', 'thymio'] };

/**
 * A key as the browser hears it of a keyboard.
 * @param {import('playwright-core').CDPSession} keyboard
 * @param {{ key: string, code: string, text?: string, modifiers?: number }} key
 */
async function pressKey(keyboard, key) {
  await keyboard.send('Input.dispatchKeyEvent', { type: 'keyDown', ...key });
  const { key: name, code } = key;
  await keyboard.send('Input.dispatchKeyEvent', { type: 'keyUp', key: name, code });
}

const enter = { key: 'Enter', code: 'Enter', windowsVirtualKeyCode: 13 };

test('Enter that takes a composed word does not end the field', wall, async (studio) => {
  const { page, context, press, layout } = studio;
  await layout('Draw');
  await page.getByRole('group', { name: /^followWall, actor/ }).click();
  await press('F2');
  const field = page.getByRole('textbox', { name: 'Name', exact: true });
  await focused(field);
  await press('Control+a');
  const keyboard = await context.newCDPSession(page);
  const word = { text: 'mur', selectionStart: 3, selectionEnd: 3 };
  await keyboard.send('Input.imeSetComposition', word);
  await pressKey(keyboard, enter);
  await pressKey(keyboard, { key: 'Escape', code: 'Escape' });
  await focused(field);
  await keyboard.send('Input.insertText', { text: 'mur' });
  assert.equal(await field.inputValue(), 'mur');
  await press('Enter');
  await gone(field);
  await seen(page.getByRole('group', { name: /^mur, actor/ }));
});

test('what Option types is typed, and Control and Option are Alt', thymio, async (studio) => {
  const { page, context, press, layout, editor } = studio;
  await page.addInitScript(() =>
    Object.defineProperty(Navigator.prototype, 'platform', { get: () => 'MacIntel' }),
  );
  await page.reload();
  await layout('Script');
  await editor('thymio-II').click();
  await press('Meta+End', 'Enter');
  const keyboard = await context.newCDPSession(page);
  const [option, control] = [1, 2];
  for (const [key, code] of [
    ['@', 'KeyL'],
    ['|', 'Digit7'],
    ['~', 'KeyN'],
    ['[', 'Digit5'],
  ])
    await pressKey(keyboard, { key, code, text: key, modifiers: option });
  await until('they are typed', async () =>
    (await editor('thymio-II').innerText()).includes('@|~['),
  );
  assert.equal(await page.getByRole('list', { name: 'Bytecode' }).count(), 0);
  await pressKey(keyboard, { key: '¬', code: 'KeyL', modifiers: option + control });
  await seen(page.getByRole('list', { name: 'Bytecode' }));
  // What is shown can be pressed.
  await press('F1');
  await page.getByRole('tab', { name: 'Keys' }).click();
  const keys = page.getByRole('dialog', { name: 'Keys' });
  await reads(keys, /Cmd\+S/);
  const shown = await reads(keys, /Ctrl\+Option\+Shift\+U/);
  assert.doesNotMatch(shown, /\bAlt\b|Ctrl\+[A-Z]\b/);
  await boxOf(keys);
});
