// Parts of the page that are loaded when they are first shown.
import assert from 'node:assert/strict';
import { gone, seen, test } from './support/studio.mjs';

test(
  'a panel that could not be loaded says so, and comes with another try',
  { words: ['--example', 'follow-wall'] },
  async (studio) => {
    const { page, press, button, complaints, layout } = studio;
    await layout('Script');
    await seen(button(/Target Simulator/));
    const part = /\/search_panel-[^/]*\.js$/;
    await page.route(part, (route) => route.abort());
    await press('Control+Shift+F');
    await seen(page.getByText('This part of the page could not be loaded.'));
    // The browser says what failed: each try, and what was shown instead.
    assert.ok(complaints.length >= 4, `the page tried by itself: ${complaints.length}`);
    complaints.splice(0);
    await page.unroute(part);
    await button('Try again').click();
    await seen(page.getByRole('textbox', { name: 'Find' }));
    await gone(page.getByText('This part of the page could not be loaded.'));
  },
);
