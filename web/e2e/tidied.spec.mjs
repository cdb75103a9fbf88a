// Random plans after Tidy, in two windows, and their geometry as the browser has it: no box stands on another, and no
// arrow runs through one.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { makeProject } from './support/robots.mjs';
import { openWindow, seen, test, until } from './support/studio.mjs';
/** @import { Page, Studio, TestContext } from './support/studio.mjs' */

// A minute for ten of them: fifty, other ones each time, only where there is time.
const isLong = process.env['VAGUS_LONG'] !== undefined;
const kPlans = isLong ? 50 : 10;
/** Of the plans in one test: each has a server of its own. */
const kPlansInOne = 5;

/** Numbers below a bound, the same for the same seed. */
function seeded(/** @type {number} */ seed) {
  let state = seed >>> 0;
  return (/** @type {number} */ below) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * below);
  };
}

/**
 * A plan whose elements stand on each other until it is tidied; its actors have names that no other plan has.
 * @param {(below: number) => number} random
 * @param {string} name
 */
function randomPlan(random, name, count = 2 + random(14)) {
  const target = () => (random(8) === 0 ? '@terminate' : `${name}a${random(count)}`);
  const one = (/** @type {number} */ at) => {
    const isLoop = random(2) === 0;
    const supervisors = Object.fromEntries(
      Array.from({ length: random(3) }, (_one, more) => [
        `${name}s${at}_${more}`,
        { template: 'Timeout', in: { seconds: 9 }, events: { Timeout: target() } },
      ]),
    );
    return {
      template: isLoop ? 'For' : 'Wait',
      in: isLoop ? { counter: 'n', last: 3 } : { seconds: 1 },
      states: isLoop ? { Loop: target(), Done: target() } : { Done: target() },
      supervisors,
    };
  };
  const names = Array.from({ length: count }, (_one, at) => `${name}a${at}`);
  return {
    format: 'vagus-plan/1',
    name: 'P',
    configuration: { n: { type: 'int', initial: 0 } },
    start: { actor: names[0] },
    actors: Object.fromEntries(names.map((actor, at) => [actor, one(at)])),
    layout: Object.fromEntries(['@start', ...names].map((actor) => [actor, [80, 80]])),
    x: {
      notes: Array.from({ length: random(3) }, (_one, at) => ({
        at: [80 + at * 240 + random(6) * 8, 80 + random(40) * 8],
        size: [192, 72],
        text: `note ${at}`,
      })),
    },
  };
}

/**
 * What is wrong with the drawing in this window. In pixels of the canvas, a line's breadth is nothing.
 * @param {Page} page
 */
const faults = (page) =>
  page.evaluate(() => {
    const kLine = 1;
    /** @typedef {{ id: string, left: number, top: number, right: number, bottom: number }} Box */
    const boxes = [...document.querySelectorAll('.react-flow__node')]
      .filter((node) => node instanceof HTMLElement && node.checkVisibility())
      .map((node) => {
        const html = /** @type {HTMLElement} */ (node);
        const { e: x, f: y } = new DOMMatrix(getComputedStyle(html).transform);
        return {
          id: html.dataset['id'] ?? '',
          left: x + kLine,
          top: y + kLine,
          right: x + html.offsetWidth - kLine,
          bottom: y + html.offsetHeight - kLine,
        };
      });
    const overlap = (/** @type {Box} */ a, /** @type {Box} */ b) =>
      a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
    /** @type {string[]} */
    const found = [];
    boxes.forEach((box, at) => {
      for (const other of boxes.slice(at + 1))
        if (overlap(box, other)) found.push(`${box.id} stands on ${other.id}`);
    });
    const cross = (/** @type {string} */ name, /** @type {DOMPoint[]} */ points) => {
      points.slice(1).forEach((to, at) => {
        const from = points[at] ?? to;
        const stretch = {
          id: name,
          left: Math.min(from.x, to.x),
          right: Math.max(from.x, to.x),
          top: Math.min(from.y, to.y),
          bottom: Math.max(from.y, to.y),
        };
        for (const box of boxes) if (overlap(box, stretch)) found.push(`${name} crosses ${box.id}`);
      });
    };
    for (const line of document.querySelectorAll('.parrow__line')) {
      const path = /** @type {SVGPathElement} */ (line);
      const name = path.closest('[role="img"]')?.getAttribute('aria-label') ?? '';
      const length = path.getTotalLength();
      cross(
        name,
        Array.from({ length: Math.ceil(length) + 1 }, (_one, at) =>
          DOMPoint.fromPoint(path.getPointAtLength(Math.min(at, length))),
        ),
      );
      const id = /url\("?#([^")]+)"?\)/.exec(path.getAttribute('marker-end') ?? '')?.[1];
      if (!path.closest('svg')?.contains(document.getElementById(id ?? '')))
        found.push(`${name} has no head`);
    }
    return found;
  });

const arrowsIn = (/** @type {ReturnType<typeof randomPlan>} */ plan) =>
  1 +
  Object.values(plan.actors).reduce(
    (sum, { states, supervisors }) =>
      sum + Object.keys(states).length + Object.keys(supervisors).length,
    0,
  );

/**
 * Both windows show the plan, without a fault.
 * @param {string} name
 * @param {readonly Page[]} pages
 * @param {{ actor: string, arrows: number }} plan
 */
async function sound(name, pages, { actor, arrows }) {
  for (const page of pages) {
    /** @type {string[]} */
    let last = [];
    await until(`${name} is sound`, async () => {
      const isShown = (await page.locator(`[data-id="${actor}"]`).count()) > 0;
      const lines = await page.locator('.parrow__line').count();
      last = isShown && lines === arrows ? await faults(page) : [`${lines} arrows`];
      return last.length === 0;
    }).catch((error) => {
      error.message += `: ${last.slice(0, 8).join('; ')}`;
      throw error;
    });
  }
}

const kFile = 'P.plan.json';
const prepare = (/** @type {TestContext} */ t) =>
  makeProject(
    t,
    { name: 'P', plan: kFile },
    { [kFile]: JSON.stringify(randomPlan(seeded(1), 'first', 2)) },
  );

/**
 * @param {Studio<{ place: string }> & { t: TestContext }} studio
 */
async function twoWindows({ t, page, layout, server }) {
  const other = await openWindow(t, server);
  await layout('Draw');
  await other.layout('Draw');
  for (const one of [page, other.page]) await seen(one.locator('.pcanvas'));
  return other;
}

const seed = Number(
  process.env['VAGUS_SEED'] ?? (isLong ? Math.floor(Math.random() * 2 ** 31) : 8),
);
console.info(`seed ${seed}`);

for (let first = 0; first < kPlans; first += kPlansInOne)
  test(
    `random plans ${first + 1} to ${first + kPlansInOne} are tidied in two windows`,
    { prepare },
    async (studio) => {
      const { page, press, place } = studio;
      const other = await twoWindows(studio);
      const file = join(place, kFile);
      const random = seeded(seed + first);
      for (let at = first; at < first + kPlansInOne; at++) {
        const plan = randomPlan(random, `p${at}`);
        const text = JSON.stringify(plan);
        const name = `seed ${seed}, plan ${at + 1}`;
        writeFileSync(file, text);
        await seen(page.locator(`[data-id="p${at}a0"]`));
        await page.locator('.pcanvas').focus();
        await press('t');
        const expected = { actor: `p${at}a0`, arrows: arrowsIn(plan) };
        await sound(name, [page, other.page], expected);
        await press('Control+s');
        await until(`${name} is saved`, () => readFileSync(file, 'utf8') !== text);
        await sound(name, [page, other.page], expected);
      }
      assert.deepEqual(other.complaints, []);
    },
  );
