// A condition that is none is refused where it is typed.
import assert from 'node:assert/strict';
import { boxOf, seen, test, gone } from './support/studio.mjs';

test(
  'a condition of a breakpoint that does not parse is refused at its field',
  { words: ['--example', 'thymio'] },
  async (studio) => {
    const { page, press, type, layout } = studio;
    await layout('Script');
    await page.getByRole('textbox', { name: /^Script of/ }).click();
    await press('Control+Home', 'Control+F9');
    const field = page.getByLabel('Stops if');
    await seen(field);
    await type('side >');
    await press('Enter');
    await seen(page.getByRole('alert').filter({ hasText: 'expected a value after “>”' }));
    await type(' 3');
    await gone(page.getByRole('alert').filter({ hasText: 'expected' }));
    await press('Enter');
    await gone(field);
  },
);

test(
  'a condition with a name that the script does not have stays in its form',
  { words: ['--example', 'thymio'] },
  async (studio) => {
    const { page, press, type, layout } = studio;
    await layout('Script');
    await page.getByRole('textbox', { name: /^Script of/ }).click();
    await press('Control+Home', 'Control+F9');
    const field = page.getByLabel('Stops if');
    await seen(field);
    await type('nobody > 3');
    await press('Enter');
    await seen(page.getByRole('alert').filter({ hasText: 'nobody' }));
    assert.equal(await field.inputValue(), 'nobody > 3');
  },
);

test(
  'a variable that the plan lacks is refused where the condition is typed',
  { words: ['--example', 'follow-wall'] },
  async (studio) => {
    const { page, press, layout } = studio;
    await layout('Debug');
    const field = page.getByLabel('Stop when');
    const before = await boxOf(field);
    await field.fill('walldits < 5');
    await press('Enter');
    await seen(
      page.getByRole('alert').filter({ hasText: 'no variable “walldits”; did you mean walldist?' }),
    );
    assert.equal(await field.inputValue(), 'walldits < 5');
    // There is room to correct it.
    assert.equal((await boxOf(field)).width, before.width);
    await field.fill('walldist < 5');
    await press('Enter');
    await seen(page.getByText('when walldist < 5'));
    await gone(page.getByRole('alert').filter({ hasText: 'walldits' }));
  },
);
