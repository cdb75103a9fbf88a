// A plan: its text with findings, and what it does.
import { reads, seen, test } from './support/studio.mjs';

const wall = { words: ['--example', 'follow-wall'] };

test(
  'a plan runs, is paused, steps and is stopped; beside it what it does',
  wall,
  async (studio) => {
    const { page, press, layout } = studio;
    await layout('Draw');
    await page.getByRole('switch', { name: 'What it does' }).click();
    const live = page.getByRole('complementary', { name: 'What the plan does' });
    await seen(live);
    await live.getByRole('button', { name: 'Start' }).click();
    await reads(live, /running/);
    await reads(live, /step \d+ of the run/);
    await live.getByRole('button', { name: 'Pause' }).click();
    await reads(live, /paused/);
    await live.getByRole('button', { name: 'Next actor' }).click();
    await live.getByRole('button', { name: 'Continue' }).click();
    await reads(live, /running/);
    await press('Shift+F5');
    await reads(live, /(ended|stopped|interrupted)/);
  },
);

test('mistakes in a plan are told at their place', wall, async (studio) => {
  const { page, press, type, layout } = studio;
  await layout('Draw');
  await page.getByRole('switch', { name: 'Text' }).click();
  const text = page.getByRole('textbox', { name: /Text of/ }).first();
  await text.click();
  await press('Control+f');
  await page.getByLabel('Find', { exact: true }).fill('"template": "');
  await press('Enter', 'Escape', 'ArrowRight');
  await type('X');
  await seen(
    page
      .getByRole('note')
      .or(page.getByRole('list', { name: 'Problems of all files' }).getByRole('listitem')),
  );
  await seen(page.getByRole('button', { name: /\d+ errors?/ }));
});
