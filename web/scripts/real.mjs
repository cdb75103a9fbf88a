// The real server and the machine's Chromium for scripts that are no tests: pictures and measuring.
export { launchBrowser } from '../e2e/support/browser.mjs';
export { root, startProgram, startServer, vagusProgram } from '../e2e/support/server.mjs';
export { until } from '../e2e/support/until.mjs';

export const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/** Does something with an owner of programs and folders, as a test is one, and deletes them at the end. */
export async function owning(act) {
  const ends = [];
  try {
    return await act({ after: (end) => ends.push(end) });
  } finally {
    for (const end of ends.reverse()) await end();
  }
}
