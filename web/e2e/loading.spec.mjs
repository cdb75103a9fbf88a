// Parts of the page that are loaded when they are first shown.
import assert from 'node:assert/strict';
import { gone, seen, test, until } from './support/studio.mjs';

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

test(
  'a layout that is chosen before the one that was kept is known stays',
  { words: ['--example', 'follow-wall'] },
  async ({ page, layout, tab }) => {
    /** @type {(() => void)[]} */
    const late = [];
    let isHeld = true;
    await page.routeWebSocket(/\/live/, (socket) => {
      const server = socket.connectToServer();
      /** @type {unknown} */
      let number = null;
      socket.onMessage((message) => {
        const order = typeof message === 'string' ? JSON.parse(message) : {};
        if (order.do === 'watch' && order.in.topic === 'state') number = order.in.watch;
        server.send(message);
      });
      server.onMessage((message) => {
        const said = typeof message === 'string' ? JSON.parse(message) : {};
        if (isHeld && number !== null && said.watch === number)
          late.push(() => socket.send(message));
        else socket.send(message);
      });
    });
    await page.reload();
    await layout('Debug');
    await until('what was kept is on its way', () => late.length > 0);
    // What the choice itself has changed is told later.
    late.shift()?.();
    await seen(tab('Watch'));
    isHeld = false;
    for (const send of late) send();
    await until('it is still the one that was chosen', () =>
      page.getByRole('radio', { name: 'Debug' }).isChecked(),
    );
  },
);
