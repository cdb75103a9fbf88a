// Waiting for what will be seen; nothing in these tests sleeps.
import assert from 'node:assert/strict';

/** So long something may take until it is seen, on a machine that does much else. */
export const kPatience = Number(process.env.VAGUS_PATIENCE ?? 30_000);
/**
 * Asks until the answer is true (or any value that counts as true), which it gives.
 * @template T
 * @param {string} what
 * @param {() => T | Promise<T>} ask
 * @returns {Promise<Exclude<T, false | 0 | '' | null | undefined>>}
 */
export async function until(what, ask, within = kPatience) {
  const end = performance.now() + within;
  /** @type {unknown} */
  let last;
  for (;;) {
    try {
      const answer = await ask();
      if (answer) return /** @type {Exclude<T, false | 0 | '' | null | undefined>} */ (answer);
      last = undefined;
    } catch (error) {
      last = error;
    }
    if (performance.now() > end)
      assert.fail(`never: ${what}${last ? `\n${String(last).slice(0, 600)}` : ''}`);
    // One painting of the page, about: asking faster would only slow down what is waited for.
    await new Promise((done) => setTimeout(done, 40));
  }
}
