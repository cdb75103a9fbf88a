// F1: the language, the robot and the keys, by keyboard alone.
import assert from 'node:assert/strict';
import { gone, reads, seen, test, until } from './support/studio.mjs';
/** @import { Page } from './support/studio.mjs' */

const thymio = { words: ['--example', 'thymio'] };

/** @param {Page} page */
const parts = (page) => ({
  field: page.getByRole('combobox', { name: 'Word of the language' }),
  chosen: page.getByRole('option', { selected: true }),
  list: page.getByRole('listbox', { name: 'What was found' }),
});

test('F1 shows the language, the robot and the keys', thymio, async ({ page, press, type }) => {
  const { field, chosen, list } = parts(page);
  await seen(page.getByRole('radio', { name: 'Script' }));
  await press('F1');
  await until('the field has the focus', () =>
    field.evaluate((one) => one === document.activeElement),
  );
  await reads(chosen, /^const/);
  await type('when');
  await reads(chosen, /^when/);
  await reads(page.getByRole('region', { name: 'when' }), /Becoming true: when[^]*when prox/);
  // What the robot tells, with an example of a page of docs/.
  await press('Control+a');
  await type('mltar');
  await reads(chosen, /^motor\.left\.target/);
  await reads(
    page.getByRole('region', { name: 'motor.left.target' }),
    /wanted speed[^]*onevent button\.center/,
  );
  await press('Control+a');
  await type('math.st');
  await reads(chosen, /^math\.stat/);
  await reads(page.getByRole('region', { name: 'math.stat' }), /call math\.stat\(src/);
  await press('Control+a');
  await type('qqqq');
  await seen(page.getByText('Nothing of that name.'));
  assert.equal(await list.getByRole('option').count(), 0);
  // To the other tab and back out.
  await press('Shift+Tab', 'Shift+Tab', 'ArrowRight');
  await seen(page.getByRole('dialog', { name: 'Keys' }));
  await press('Escape');
  await gone(page.getByRole('dialog', { name: 'Keys' }));
});

test('F1 at a word of a script shows that word', thymio, async (studio) => {
  const { page, press, layout, type } = studio;
  const { field, chosen } = parts(page);
  await layout('Script');
  const editor = page.getByRole('textbox', { name: /^Script of/ });
  await editor.click();
  await press('Control+End', 'Enter');
  await type('call leds.top(1, 2, 3)');
  await press('Home', 'ArrowRight', 'Control+ArrowRight', 'ArrowRight', 'ArrowRight', 'F1');
  await until('the word is in the field', async () => (await field.inputValue()) === 'leds.top');
  await reads(chosen, /^leds\.top/);
  await press('Escape');
  await until('the editor has the focus again', () =>
    editor.evaluate((one) => one === document.activeElement),
  );
});

test(
  'the help fits into a small window',
  { ...thymio, width: 640, height: 400 },
  async ({ page, press }) => {
    await seen(page.getByRole('radio', { name: 'Script' }));
    await press('F1');
    const text = page.getByRole('region', { name: 'const' });
    await seen(text);
    const box = await text.boundingBox();
    assert.ok(box && box.height > 60 && box.y + box.height <= 400 && box.x + box.width <= 640);
    await page.getByRole('button', { name: 'Close' }).last().click();
    await gone(text);
  },
);
