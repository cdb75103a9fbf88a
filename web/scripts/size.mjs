// What the browser fetches until the first view is shown, as it goes over the wire: node scripts/size.mjs
// The figures are bytes, not seconds: the test web.size.
import { launchBrowser, owning, startServer } from './real.mjs';

/** What is fetched until the start screen or the window of a project is complete; by address: bytes. */
export async function fetched(page, address, seen) {
  const session = await page.context().newCDPSession(page);
  await session.send('Network.enable');
  const files = new Map();
  const bytes = new Map();
  session.on('Network.responseReceived', ({ requestId, response }) =>
    files.set(requestId, new URL(response.url).pathname),
  );
  session.on('Network.loadingFinished', ({ requestId, encodedDataLength }) =>
    bytes.set(files.get(requestId) ?? requestId, encodedDataLength),
  );
  await page.goto(address);
  await seen(page);
  await page.waitForLoadState('networkidle');
  return bytes;
}

export const sumOf = (bytes) => [...bytes.values()].reduce((sum, one) => sum + one, 0);

const scriptSeen = (page) => page.locator('.cm-content').first().waitFor();

const firstViews = [
  {
    name: 'start screen',
    most: 600_000,
    words: [],
    seen: (page) => page.getByRole('heading', { name: 'Take an example' }).waitFor(),
  },
  {
    name: 'window of a project',
    most: 600_000,
    words: ['--example', 'epuck'],
    seen: scriptSeen,
  },
  // What its tests need comes with it (app/follow_tests.ts).
  {
    name: 'window of a project with tests',
    most: 615_000,
    words: ['--example', 'thymio'],
    seen: scriptSeen,
  },
];

async function main() {
  const browser = await launchBrowser();
  let failed = false;
  for (const { name, most, words, seen } of firstViews)
    await owning(async (owner) => {
      const { address } = await startServer(owner, words);
      const context = await browser.newContext();
      owner.after(() => context.close());
      const bytes = await fetched(await context.newPage(), address, seen);
      const sum = sumOf(bytes);
      console.log(`figure: ${name}: ${(sum / 1000).toFixed(0)} kB in ${bytes.size} files`);
      const late = [...bytes.keys()].filter((file) => /solid_view|plan_canvas/.test(file));
      if (late.length > 0) console.log(`fetched before it is needed: ${late}`);
      if (sum > most || late.length > 0) {
        failed = true;
        for (const [file, one] of [...bytes].sort((a, b) => b[1] - a[1]).slice(0, 12))
          console.log(`  ${one} ${file}`);
      }
    });
  await browser.close();
  process.exit(failed ? 1 : 0);
}

if (process.argv[1] === new URL(import.meta.url).pathname) await main();
