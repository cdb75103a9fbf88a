// A browser that is killed in the middle of typing takes nothing with it that was typed a second before.
import assert from 'node:assert/strict';
import { randomInt } from 'node:crypto';
import { test } from 'node:test';
import { chromium } from 'playwright-core';
import { makeProject, startNode } from './support/robots.mjs';
import { atEnd, startServer } from './support/server.mjs';
import { browserOptions } from './support/browser.mjs';
import { hands } from './support/studio.mjs';
import { until } from './support/until.mjs';
/** @import { Page, TestContext } from './support/studio.mjs' */

const kKills = Number(process.env.VAGUS_KILLS ?? 4);
const kTestMs = 60_000 + kKills * 20_000;
const kSecond = 1000;
const kLettersMax = 80;

/** A browser of its own, which can be killed. */
async function launch(/** @type {TestContext} */ t) {
  const server = await chromium.launchServer(browserOptions);
  atEnd(t, () => server.kill());
  const browser = await chromium.connect(server.wsEndpoint());
  return { page: await browser.newPage(), kill: () => server.kill() };
}

async function open(/** @type {TestContext} */ t, /** @type {string} */ address) {
  const { page, kill } = await launch(t);
  await page.goto(address);
  const editor = hands(page).editor('left');
  await editor.waitFor();
  const text = async () => (await editor.innerText()).replaceAll('\u200b', '');
  await until('it has its text', async () => (await text()).includes('var n'));
  return { page, kill, editor, text };
}

void test('a browser is killed while someone types', { timeout: kTestMs }, async (t) => {
  const node = await startNode(t, 'left', 1);
  const project = makeProject(
    t,
    { name: 'One', scripts: ['one.aesl'], target: `tcp:127.0.0.1:${node.port}` },
    {
      'one.aesl':
        '<!DOCTYPE aesl-source>\n<network>\n<node nodeId="1" name="left"><![CDATA[var n\n#]]></node>\n</network>\n',
    },
  );
  const { address } = await startServer(t, project.words, project.folder);
  /** @type {any[]} */
  let typed = [];
  let killed = 0;
  for (let turn = 0; ; turn++) {
    const { page, kill, editor, text } = await open(t, address);
    const found = (await text()).split('#')[1].trim();
    const whole = wordOf(typed);
    const surely = wordOf(typed.filter(({ when }) => when < killed - kSecond));
    assert.ok(found.startsWith(surely), `typed "${whole}", found "${found}"`);
    assert.ok(whole.startsWith(found), `typed "${whole}", found "${found}"`);
    if (turn === kKills) return;

    await drive(page);
    await editor.click();
    await page.keyboard.press('Control+End');
    typed = [...found].map((letter) => ({ letter, when: 0 }));
    for (let left = randomInt(kLettersMax); left > 0; left--) {
      const letter = String.fromCharCode(97 + (left % 26));
      await page.keyboard.type(letter);
      await drawn(page);
      typed.push({ letter, when: performance.now() });
    }
    killed = performance.now();
    await kill();
  }
});

const wordOf = (/** @type {string[]} */ typed) =>
  typed.map((/** @type {any} */ one) => one.letter).join('');

/** A person types what they see: the next key comes when this one is drawn, and the page has had a moment. */
const drawn = (/** @type {Page} */ page) =>
  page.evaluate(() => new Promise((done) => requestAnimationFrame(() => setTimeout(done))));

/** A page that comes within ten seconds of a death requests control. */
async function drive(/** @type {Page} */ page) {
  const wheel = page.getByRole('button', { name: 'Request control' });
  await wheel
    .or(page.getByRole('button', { name: 'Upload' }))
    .first()
    .waitFor();
  if (await wheel.isVisible()) await wheel.click();
  await wheel.waitFor({ state: 'hidden' });
}
