// What the editor says below a line, and its list of completions, where they would be in the way or out of sight.
import assert from 'node:assert/strict';
import { gone, seen, test, until } from './support/studio.mjs';

const thymio = { words: ['--example', 'thymio'], width: 1280, height: 720 };

test('the sentence below the last line comes into sight', thymio, async (studio) => {
  const { page, press, type, editor } = studio;
  await editor('thymio-II').click();
  await press('Control+End');
  await type('\nmotor.left.targ = 1');
  const sentence = page.getByRole('note').filter({ hasText: 'motor.left.target' });
  await seen(sentence);
  await until('all of it is within the editor', async () => {
    const said = await sentence.boundingBox();
    const frame = await page.locator('.cm-scroller').first().boundingBox();
    return said && frame && said.y + said.height <= frame.y + frame.height;
  });
});

test('a sentence that more of its line does not change comes, too', thymio, async (studio) => {
  const { page, press, type, editor } = studio;
  await editor('thymio-II').click();
  await press('Control+End');
  await type('\nmotor.left.targ');
  await seen(page.getByRole('button', { name: '1 error' }));
  await type(' = 1');
  await seen(page.getByRole('note').filter({ hasText: 'motor.left.target' }));
});

test('a list of completions goes when a keyword is complete', thymio, async (studio) => {
  const { page, press, type, editor } = studio;
  await editor('thymio-II').click();
  await press('Control+End');
  await type('\nen');
  const list = page.getByRole('listbox');
  await seen(list.getByRole('option', { name: /^end/ }));
  await type('d');
  await gone(list);
  await press('Enter');
  await type('x');
  const lines = await page.locator('.cm-line').allInnerTexts();
  assert.deepEqual(lines.slice(-2), ['end', 'x']);
});
