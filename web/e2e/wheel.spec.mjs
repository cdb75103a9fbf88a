// Who drives, when pages come and go.
import { openWindow, reads, seen, test, until } from './support/studio.mjs';
/** @import { Studio } from './support/studio.mjs' */

test(
  'a page that opens after the only other one was closed drives at once',
  { words: ['--example', 'thymio'] },
  async (studio, t) => {
    await seen(studio.editor('thymio-II'));
    await studio.context.close();
    const second = await openWindow(t, studio.server);
    const upload = (/** @type {Studio} */ window) => window.button('Upload');
    await until('it may change the robot', () => upload(second).isEnabled());
    // While a page drives, one more only looks.
    const third = await openWindow(t, studio.server);
    await seen(third.button('Request control'));
    await until('the third one looks', () => upload(third).isDisabled());
    await until('the second one drives still', () => upload(second).isEnabled());
  },
);

test(
  'who requests control is told what becomes of it',
  { words: ['--example', 'thymio'] },
  async (studio, t) => {
    const { page, button } = studio;
    await seen(studio.editor('thymio-II'));
    const other = await openWindow(t, studio.server);
    const told = other.page.locator('.notices');
    const ask = other.button('Request control');
    await ask.click();
    await reads(told, /control is requested of the other page/);
    await until('one request is enough', () => ask.isDisabled());
    await seen(page.getByText('Another page requests control.'));
    await button('Keep control').click();
    await reads(told, /the other page keeps control/);
    await ask.click();
    await button('Release control').click();
    await seen(page.getByText('View only: another page has control.'));
    await until('the other one drives', () => other.button('Upload').isEnabled());
  },
);
