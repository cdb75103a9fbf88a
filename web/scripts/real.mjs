// The real server and the machine's Chromium for scripts that are no tests: pictures and measuring.
import { chromium } from 'playwright-core';

export { root, startProgram, startServer, vagusProgram } from '../e2e/support/server.mjs';
export const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/** Asks until the answer counts as true, which it gives. */
export async function until(what, ask, within = 30_000) {
  const end = performance.now() + within;
  for (;;) {
    const answer = await ask();
    if (answer) return answer;
    if (performance.now() > end) throw new Error(`it did not come: ${what}`);
    await pause(20);
  }
}

/** Does something with an owner of programs and folders, as a test is one, and takes them away at the end. */
export async function owning(act) {
  const ends = [];
  try {
    return await act({ after: (end) => ends.push(end) });
  } finally {
    for (const end of ends.reverse()) await end();
  }
}

export function launchBrowser() {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: [
      '--no-sandbox',
      '--disable-gpu',
      '--enable-unsafe-swiftshader',
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
      '--force-color-profile=srgb',
    ],
  });
}
