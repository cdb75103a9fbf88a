// The studio in the machine's Chromium, as a person sees it. One browser for a file of tests, a window of its
// own for each test; what the browser complains about fails the test.
import assert from 'node:assert/strict';
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, test as nodeTest } from 'node:test';
import { launchBrowser } from './browser.mjs';
import { atEnd, root, startServer } from './server.mjs';
import { kPatience, until } from './until.mjs';

export { until };

/** What drawing by software says of itself, and of tests that read what is drawn. */
const kNoise = /GL Driver Message|operations using getImageData are faster/;
const kTestMs = 150_000;
const kPictures = join(root, 'build/e2e');

/**
 * @typedef {import('playwright-core').Page} Page
 * @typedef {import('playwright-core').Locator} Locator
 * @typedef {import('node:test').TestContext} TestContext
 * @typedef {import('./server.mjs').Server} Server
 *
 * How a window looks; scale: pixels of the screen for each of the page.
 * @typedef {{ width?: number, height?: number, scale?: number, theme?: 'dark' | 'light', touch?: boolean }} Looks
 *
 * What a test's own files say to the server: words of the command line, the folder that it keeps its data in.
 * @typedef {{ words?: readonly string[], folder?: string }} Prepared
 *
 * @typedef {Awaited<ReturnType<typeof openWindow>>} Window
 */
/**
 * @template {Prepared} More
 * @typedef {Looks & { words?: readonly string[], prepare?: (t: TestContext) => More | Promise<More> }} Options
 */
/**
 * What a test gets: a window, its server, and what `prepare` gave.
 * @template [More={}]
 * @typedef {{ t?: TestContext } & Window & More} Studio
 */

/** @type {import('playwright-core').Browser | undefined} */
let browser;
after(async () => {
  await browser?.close();
});

async function theBrowser() {
  browser ??= await launchBrowser();
  return browser;
}

/**
 * A test of one promise; give it what openStudio takes and what is done there.
 * @template {Prepared} [More={}]
 * @param {string} name
 * @param {Options<More>} options
 * @param {(studio: Studio<More> & { t: TestContext }, t: TestContext) => unknown} act
 */
export function test(name, options, act) {
  void nodeTest(name, { timeout: kTestMs }, async (t) => {
    const studio = { t, ...(await openStudio(t, options)) };
    try {
      await act(studio, t);
      assert.deepEqual(studio.complaints, [], 'the browser complained');
    } catch (problem) {
      const error = problem instanceof Error ? problem : new Error(String(problem));
      await keepPicture(studio, name);
      error.message += `\n--- fetched in vain: ${[...studio.fetching].join(' ') || 'nothing'}; complaints: ${studio.complaints.join(' ') || 'none'}`;
      error.message += `\n--- the server said ---\n${studio.server.program.said.slice(-2000)}`;
      throw error;
    }
  });
}

/**
 * @param {{ page: Page }} studio
 * @param {string} name
 */
async function keepPicture({ page }, name) {
  mkdirSync(kPictures, { recursive: true });
  const path = join(kPictures, `${name.replaceAll(/[^A-Za-z0-9]+/g, '-')}.png`);
  await page.screenshot({ path }).catch(() => {});
  const shown = await page
    .locator('body')
    .ariaSnapshot({ timeout: 2000 })
    .catch(() => '');
  writeFileSync(path.replace('.png', '.txt'), shown);
  console.error(`what was seen: ${path}`);
}

/**
 * A server and a window that looks at it.
 * @template {Prepared} [More={}]
 * @param {TestContext} t
 * @param {Options<More>} options
 */
export async function openStudio(t, { words = [], prepare, ...looks } = {}) {
  const more = /** @type {More} */ ((await prepare?.(t)) ?? {});
  const server = await startServer(t, [...words, ...(more.words ?? [])], more.folder);
  return { ...(await openWindow(t, server, looks)), server, ...more };
}

/**
 * One more window of that server.
 * @param {TestContext} t
 * @param {Server} server
 * @param {Looks} looks
 */
export async function openWindow(
  t,
  server,
  { width = 1440, height = 900, scale = 1, theme = 'dark', touch = false } = {},
) {
  const context = await (
    await theBrowser()
  ).newContext({
    viewport: { width, height },
    deviceScaleFactor: scale,
    hasTouch: touch,
    isMobile: touch,
    colorScheme: theme,
    reducedMotion: 'reduce',
    acceptDownloads: true,
    permissions: ['clipboard-read', 'clipboard-write'],
  });
  context.setDefaultTimeout(kPatience);
  atEnd(t, () => context.close());
  const page = await context.newPage();
  /** @type {string[]} */
  const complaints = [];
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type()) && !kNoise.test(message.text()))
      complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(String(error)));
  /** @type {Set<string>} */
  const fetching = new Set();
  page.on('request', (request) => fetching.add(request.url()));
  page.on('requestfinished', (request) => fetching.delete(request.url()));
  page.on('requestfailed', (request) => fetching.delete(request.url()));
  await page.goto(server.address);
  // The page is loaded before anything is drawn in it, and hears no key until then.
  await page.locator('#root > *').first().waitFor({ state: 'attached' });
  return { page, complaints, fetching, context, server, ...hands(page) };
}

/** @typedef {string | RegExp} Name */

/**
 * What tests say often.
 * @param {Page} page
 */
export function hands(page) {
  /** @param {...string} keys */
  const press = async (...keys) => {
    for (const key of keys) await page.keyboard.press(key);
  };
  return {
    press,
    type: (/** @type {string} */ text) => page.keyboard.type(text),
    button: (/** @type {Name} */ name) => page.getByRole('button', { name }),
    tab: (/** @type {Name} */ name) => page.getByRole('tab', { name }),
    /**
     * A command by the palette, as its title names it.
     * @param {string} title
     */
    async command(title) {
      await page.keyboard.press('Control+k');
      const field = page.getByRole('combobox', { name: 'Type a command' });
      await field.waitFor();
      await field.fill(title);
      await page.getByRole('option', { name: title, selected: true }).first().waitFor();
      await field.press('Enter');
      await field.waitFor({ state: 'detached' });
    },
    layout: (/** @type {Name} */ name) => page.getByRole('radio', { name }).click(),
    /** The editor of a node's script. */
    editor: (/** @type {string} */ node) =>
      page.getByRole('textbox', { name: `Script of ${node}` }),
  };
}

/**
 * What is seen there becomes that text, or matches.
 * @param {Locator} locator
 * @param {string | RegExp} expected
 * @returns {Promise<string>}
 */
export async function reads(locator, expected) {
  const good = (/** @type {string} */ text) =>
    expected instanceof RegExp ? expected.test(text) : text.trim() === expected;
  let last = '';
  await until(`it reads ${expected}`, async () => {
    last = await locator.innerText();
    return good(last);
  }).catch((error) => {
    error.message += `; it read: ${last}`;
    throw error;
  });
  return last;
}

/**
 * Where it is on the screen.
 * @param {Locator} locator
 */
export async function boxOf(locator) {
  const box = await locator.boundingBox();
  assert.ok(box, `${locator} is not on the screen`);
  return box;
}

/** @param {Locator} locator */
export const seen = (locator) => locator.first().waitFor();
/**
 * Keys are for it, or for something in it.
 * @param {Locator} locator
 */
export const focused = (locator) =>
  until('it has the focus', () => locator.evaluate((one) => one.contains(document.activeElement)));
/** @param {Locator} locator */
export const gone = (locator) => locator.first().waitFor({ state: 'hidden' });
