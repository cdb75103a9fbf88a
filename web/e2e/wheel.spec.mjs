// Who drives, when pages come and go.
import { openWindow, seen, test, until } from './support/studio.mjs';
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
