// Looking back while a robot runs: what every panel shows is worked out from the trace of the run.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { look } from './support/axe.mjs';
import { makeProject } from './support/robots.mjs';
import { boxOf, gone, openWindow, reads, seen, test, until } from './support/studio.mjs';
/** @import { Locator, Page, Studio, TestContext } from './support/studio.mjs' */

const wall = { words: ['--example', 'follow-wall'] };
/** Where examples/follow-wall/hall.world.json puts its robot: -1.1 rad are -63.0°. */
const kStart = '0.80 1.90 -63°';

const slider = (/** @type {Page} */ page) =>
  page.getByRole('slider', { name: 'Instant that is shown' });
const bar = (/** @type {Page} */ page) => page.getByRole('region', { name: 'Looking back' });
const time = async (/** @type {Page} */ page) =>
  Number(await slider(page).getAttribute('aria-valuenow'));
const clock = async (/** @type {Page} */ page) =>
  parseFloat(await page.locator('.clock__time').innerText());

/** The plan runs in the layout Debug, with the timeline in front. */
async function run(/** @type {Studio} */ { page, press, layout }, /** @type {number} */ seconds) {
  await layout('Debug');
  await page.getByRole('tab', { name: 'Timeline' }).click();
  await press('F5');
  await seen(page.getByRole('button', { name: /Running/ }));
  await seen(slider(page));
  await until(`${seconds} s of the run`, async () => (await clock(page)) > seconds);
}

/** As the timeline is drawn: a click on its lanes, at a part of their width. */
async function click(/** @type {Page} */ page, /** @type {number} */ part) {
  const box = await boxOf(slider(page));
  await page.mouse.click(box.x + box.width * part, box.y + 8);
  await seen(bar(page));
  return time(page);
}

async function savedTrace(/** @type {Studio} */ { page, server }) {
  await page.getByRole('button', { name: 'Save the trace as a file of the project' }).click();
  const name = 'WallFollow-1.trace.jsonl';
  const path = await until('the trace is a file', () =>
    readdirSync(server.folder, { recursive: true, encoding: 'utf8' }).find((one) =>
      one.endsWith(name),
    ),
  );
  const text = readFileSync(join(server.folder, path), 'utf8');
  return text
    .trim()
    .split('\n')
    .map((line) => JSON.parse(line));
}

const focused = (/** @type {Locator} */ locator) =>
  locator.evaluate((/** @type {any} */ element) => element === document.activeElement);

/** The actor of an instant, by the lines until then. */
const actorAt = (/** @type {any[]} */ trace, /** @type {number} */ t) =>
  trace.findLast((/** @type {any} */ line) => line.kind === 'actor-start' && line.t <= t);
const variableAt = (
  /** @type {any[]} */ trace,
  /** @type {string} */ name,
  /** @type {number} */ t,
) =>
  trace.findLast(
    (/** @type {any} */ line) => line.kind === 'write' && line.variable === name && line.t <= t,
  ).value;

test(
  'ten seconds ago every panel shows that instant, and the robot drives on',
  wall,
  async (studio) => {
    const { page, press, layout } = studio;
    await layout('Debug');
    await page.getByRole('switch', { name: 'What it does' }).click();
    await run(studio, 16);
    const ago = (await clock(page)) - 10;
    const t = await click(page, ago / 30);
    assert.ok(Math.abs(t - ago) < 0.2, `${t} s instead of ${ago} s`);
    await reads(bar(page), new RegExp(`Everything shows ${t.toFixed(3)} s`));
    const trace = await savedTrace(studio);
    const actor = actorAt(trace, t);
    const live = page.getByRole('complementary', { name: 'What the plan does' });
    await reads(live, new RegExp(`${actor.actor}[^]*step ${actor.activation} of the run`));
    await reads(
      live,
      new RegExp(`since ${(t - actor.t).toFixed(1)} s|${(t - actor.t).toFixed(1)} s`),
    );
    await until('variables are those of then', async () => {
      const shown = await live.getByRole('textbox', { name: /wallangle/ }).inputValue();
      return Math.abs(Number(shown) - variableAt(trace, 'wallangle', t)) < 0.001;
    });
    await seen(page.getByText('Dashed: where it is now'));
    // Changing what runs is not offered; Stop is.
    const controls = page.getByRole('group', { name: 'Run controls' });
    assert.equal(await controls.getByRole('button', { name: 'Pause' }).count(), 0);
    assert.ok(await live.getByRole('button', { name: 'Pause' }).isDisabled());
    await seen(page.getByRole('button', { name: /^Stop/ }));
    await page.getByRole('tab', { name: /^Events/ }).click();
    await until('the newest event is of then', async () => {
      const newest = Number(await page.locator('.events__list time').first().innerText());
      return newest <= t && newest > t - 1;
    });
    // It runs on meanwhile.
    const before = parseFloat(await bar(page).innerText());
    await until(
      'more time lies between',
      async () => parseFloat(await bar(page).innerText()) > before + 1,
    );
    await press('Escape');
    await gone(bar(page));
    await seen(controls.getByRole('button', { name: 'Pause' }));
    await until('events of now', async () => {
      const newest = Number(await page.locator('.events__list time').first().innerText());
      return newest > t + 9;
    });
  },
);

test(
  'at its start the robot is where the world file puts it, and its wheel does not turn',
  wall,
  async (studio) => {
    const { page, press } = studio;
    await run(studio, 6);
    await page.getByRole('tab', { name: 'Watch' }).click();
    await page.getByLabel('node.variable').fill('drive.wheel.rear.speed');
    await press('Enter');
    await press('F8');
    const row = page.getByRole('list', { name: 'Watch' }).locator('.variable');
    await until(
      'now it turns',
      async () => Number(await row.locator('.value__now').innerText()) > 100,
    );
    // In the middle of the first way, 20 cm/s by the plan: 200 mm/s.
    await click(page, 3 / 30);
    await until('then it turned', async () => {
      const then = Number(await row.locator('.value__now').innerText());
      return then > 190 && then < 210;
    });
    await click(page, 0.0005);
    await slider(page).focus();
    for (let t = await time(page); t > 0; t = await time(page)) await press('ArrowLeft');
    await reads(row.locator('.value__now'), /^(0|not recorded)$/);
    await until(
      'now is beside it',
      async () => Number(await row.locator('.value__before').innerText()) > 100,
    );
    const things = page.getByRole('table', { name: 'Things' });
    await until('it is at its start', async () => {
      const cells = things.getByRole('row', { name: /carbot/i }).getByRole('cell');
      return (await cells.allInnerTexts()).join(' ') === kStart;
    });
  },
);

test('two pages look at one run, each at an instant of its own', wall, async (studio, t) => {
  const { page, press, server } = studio;
  await run(studio, 6);
  // What is in sight moves on after 30 s, and a second window may take as long.
  await press('F8');
  await reads(page.locator('.clock'), /Paused/);
  const other = await openWindow(t, server, {});
  await other.layout('Debug');
  await other.page.getByRole('tab', { name: 'Timeline' }).click();
  await seen(slider(other.page));
  const first = await click(page, 2 / 30);
  assert.equal(await bar(other.page).count(), 0);
  const second = await click(other.page, 4 / 30);
  assert.ok(Math.abs(first - 2) < 0.2 && Math.abs(second - 4) < 0.2, `${first} s, ${second} s`);
  assert.equal(await time(page), first);
  await press('Escape');
  await gone(bar(page));
  await reads(bar(other.page), new RegExp(`Everything shows ${second.toFixed(3)} s`));
  assert.deepEqual(other.complaints, []);
});

test('a page that comes back sees what it missed', wall, async (studio) => {
  const { page } = studio;
  await run(studio, 3);
  const away = await clock(page);
  await page.goto('about:blank');
  // Somebody looks after it meanwhile: the run belongs to the server.
  await page.goto(studio.server.address);
  await studio.layout('Debug');
  await page.getByRole('tab', { name: 'Timeline' }).click();
  await until('more of the run', async () => (await clock(page)) > away + 1);
  const table = page.getByRole('table', { name: 'What actors did in the seconds that are shown' });
  await seen(table.getByRole('row', { name: /^searchFirstWall 0\.000/ }));
  const then = await click(page, 1 / 30);
  assert.ok(then < away, `${then} s was before it left at ${away} s`);
  const badge = page.locator('.pastbadge').first();
  await until(
    'the badge says when',
    async () => (await badge.getAttribute('data-time')) === `${then.toFixed(3)} s`,
  );
});

test('by keyboard alone: to the steps of the plan, and by 20 ms', wall, async (studio) => {
  const { page, press, layout, command } = studio;
  await layout('Debug');
  await press('F5');
  await seen(page.getByRole('button', { name: /Running/ }));
  // The first step: a wall is near, after about 8 s.
  await until('a step of the plan', async () => (await clock(page)) > 12);
  await press('F8');
  await command('Show Timeline');
  await seen(slider(page));
  for (let presses = 0; !(await focused(slider(page))); presses++) {
    assert.ok(presses < 40, 'the timeline is reached by Tab');
    await press('Tab');
  }
  await press('Shift+ArrowLeft');
  await seen(bar(page));
  const step = await until('a step', async () => (await time(page)) > 1 && time(page));
  await press('ArrowRight', 'ArrowRight', 'ArrowLeft');
  await until('20 ms on', async () => Math.abs((await time(page)) - step - 0.02) < 1e-6);
  await press('Shift+ArrowLeft');
  await until('at the step again', async () => Math.abs((await time(page)) - step) < 1e-6);
  const trace = await savedTrace(studio);
  const steps = trace.filter(({ kind }) => kind === 'actor-end' || kind === 'event');
  assert.ok(
    steps.some(({ t }) => Math.abs(t - step) < 1e-6),
    `${step} s is a step of the plan`,
  );
  await look(studio, 'looking back');
  await press('Escape');
  await gone(bar(page));
});

test(
  'the world of then has its sensor rays and the picture of its camera',
  wall,
  async (studio) => {
    const { page, press } = studio;
    await run(studio, 6);
    await press('F8');
    const caption = page.locator('.world__camera figcaption');
    await reads(caption, /^carbot$/);
    const t = await click(page, 3 / 30);
    // A picture is kept each second.
    await reads(caption, new RegExp(`^carbot at ${Math.floor(t)}\\.0 s$`));
    const world = page.getByRole('application', { name: /^World/ });
    const drawn = () =>
      world
        .locator('canvas')
        .first()
        .evaluate((canvas) => /** @type {any} */ (canvas).toDataURL());
    await world.focus();
    await until('it stays as it was then', async () => (await drawn()) === (await drawn()));
    const rays = await drawn();
    await press('r');
    await until('the rays of then are hidden', async () => (await drawn()) !== rays);
    await press('r');
    await until('and shown again', async () => (await drawn()) === rays);
    await press('Escape');
    await gone(bar(page));
    await reads(caption, /^carbot$/);
  },
);

// Pictures of four cameras are kept: the fifth robot has none, of no instant.
test(
  'where no picture of a camera was kept, its place says so',
  {
    prepare: (/** @type {TestContext} */ t) =>
      makeProject(
        t,
        { name: 'Five', world: 'five.world.json' },
        {
          'five.world.json': JSON.stringify({
            format: 'vagus-world/1',
            name: 'Five',
            size: [6, 2],
            robots: [1, 2, 3, 4, 5].map((i) => ({ name: `r${i}`, type: 'carbot', at: [i, 1] })),
          }),
        },
      ),
  },
  async (studio) => {
    const { page, press } = studio;
    await run(studio, 3);
    await press('F8');
    const camera = page.locator('.world__camera');
    const caption = camera.locator('figcaption');
    const look = async (/** @type {RegExp} */ says) => {
      await page.getByRole('application', { name: /^World/ }).focus();
      for (let presses = 0; !says.test(await caption.innerText()); presses++) {
        assert.ok(presses < 10, `N comes to ${says}`);
        await press('n');
        await seen(camera);
      }
    };
    await look(/^r5$/);
    const picture = camera.getByRole('img', { name: 'What the camera of r5 sees' });
    await seen(picture);
    await click(page, 2 / 30);
    await reads(caption, /^No picture of r5 was kept of this instant\.$/);
    assert.equal(await picture.isVisible(), false);
    // Of the others there is one.
    await look(/^r[1-4] at \d+\.\d s$/);
    await seen(camera.getByRole('img'));
  },
);

test('a trace that was saved is opened without a run', wall, async (studio) => {
  const { page, press, layout, command } = studio;
  await run(studio, 3);
  const trace = await savedTrace(studio);
  await press('Shift+F5');
  await layout('Draw');
  await page.getByRole('switch', { name: 'What it does' }).click();
  await command('Show Project');
  await page.getByRole('treeitem', { name: /WallFollow-1\.trace\.jsonl/ }).dblclick();
  await reads(bar(page), /Showing WallFollow-1\.trace\.jsonl\.\s*Everything shows 0\.000 s/);
  const live = page.getByRole('complementary', { name: 'What the plan does' });
  await reads(live, new RegExp(`${actorAt(trace, 0).actor}[^]*step 1 of the run`));
  await press('Escape');
  await gone(bar(page));
});

for (const theme of /** @type {const} */ (['dark', 'light']))
  test(
    `axe finds nothing while a person looks back, ${theme}`,
    { ...wall, theme },
    async (studio) => {
      const { page } = studio;
      await run(studio, 3);
      await click(page, 2 / 30);
      await look(studio, 'looking back');
    },
  );

test(
  'the script shows the line of then, and none while its node was running',
  { words: ['--example', 'thymio'] },
  async (studio) => {
    const { page, press, layout, command, editor } = studio;
    await layout('Script');
    await editor('thymio-II').click();
    await command('Find in this text');
    await page.keyboard.type('onevent prox');
    await press('Enter', 'Escape', 'ArrowDown', 'F9', 'F5');
    const standing = page.locator('.cm-standing');
    await seen(standing);
    await command('20 ms back');
    await seen(bar(page));
    await gone(standing);
    await command('20 ms on');
    await seen(standing);
    await press('Escape');
    await gone(bar(page));
    await seen(standing);
  },
);
