// Two versions of a plan as one drawing: marks at what differs, ghosts of what is no more, the way from
// difference to difference by keys.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { look } from './support/axe.mjs';
import { makeProject } from './support/robots.mjs';
import { vagusProgram } from './support/server.mjs';
import { gone, reads, seen, test, until } from './support/studio.mjs';
/** @import { Page, Studio, TestContext } from './support/studio.mjs' */

/** @typedef {Record<string, any>} Plan */

const text = (/** @type {Plan} */ plan) => `${JSON.stringify(plan, null, 2)}\n`;
const copy = (/** @type {Plan} */ plan) => /** @type {Plan} */ (structuredClone(plan));

/** @type {Plan} */
const kPlan = {
  format: 'vagus-plan/1',
  name: 'P',
  configuration: {
    seconds: { type: 'float', initial: 1000 },
    word: { type: 'string', initial: 'hello' },
  },
  start: {
    actor: 'stay',
    supervisors: {
      over: { template: 'Timeout', in: { seconds: 9000 }, events: { Timeout: 'say' } },
    },
  },
  actors: {
    stay: {
      template: 'Wait',
      in: { seconds: 'seconds' },
      states: { Done: 'say' },
      supervisors: {
        late: { template: 'Timeout', in: { seconds: 100000 }, events: { Timeout: 'say' } },
      },
    },
    say: { template: 'Log', in: { text: 'word' }, states: { Done: 'hold' } },
    hold: { template: 'WaitForever' },
  },
  layout: { stay: [120, 80], say: [120, 260], hold: [420, 260] },
};

const room = {
  format: 'vagus-world/1',
  name: 'Room',
  size: [3, 3],
  robots: [{ name: 'alice', type: 'thymio2', at: [0.5, 0.5], node: 1 }],
};

/** By hand: what a person does to a plan in an afternoon. */
const versions = [
  kPlan,
  (() => {
    const plan = copy(kPlan);
    plan.actors.stay.in.seconds = 'seconds * 2';
    delete plan.actors.hold;
    plan.actors.say.states.Done = '@terminate';
    delete plan.layout.hold;
    return plan;
  })(),
  (() => {
    const plan = copy(kPlan);
    delete plan.actors.stay.supervisors;
    delete plan.configuration.word;
    plan.actors.say.in.text = "'!'";
    plan.actors.pause = { template: 'Wait', in: { seconds: 2 }, states: { Done: 'say' } };
    plan.actors.stay.states.Done = 'pause';
    plan.layout = { stay: [0, 0], say: [300, 300], hold: [600, 0], pause: [300, 0] };
    return plan;
  })(),
  (() => {
    const plan = copy(kPlan);
    plan.start.actor = 'say';
    plan.start.supervisors = {};
    plan.help = 'Another one.';
    plan.configuration = { word: kPlan.configuration.word, seconds: kPlan.configuration.seconds };
    return plan;
  })(),
];

/**
 * What must be marked: from the two files alone, without the list of differences.
 * @param {Plan} before
 * @param {Plan} after
 */
function expected(before, after) {
  const [was, is] = [partsOf(before), partsOf(after)];
  /** @type {string[]} */
  const marks = [];
  for (const [key, value] of is)
    if (!was.has(key)) marks.push(`added ${key}`);
    else if (was.get(key) !== value) marks.push(`changed ${key}`);
  for (const key of was.keys()) if (!is.has(key)) marks.push(`removed ${key}`);
  return marks.sort();
}

/** Each element and arrow of a plan with all that is its own. @param {Plan} plan */
function partsOf(plan) {
  /** @type {Map<string, string>} */
  const parts = new Map();
  const element = (/** @type {string} */ key, /** @type {Plan} */ value) => {
    const { states = {}, events = {}, supervisors = {}, ...own } = value;
    if (key !== '@start') parts.set(key, JSON.stringify(own));
    for (const [name, target] of Object.entries({ ...states, ...events }))
      parts.set(`${key}.${name}`, String(target));
    for (const [name, one] of Object.entries(supervisors)) element(`${key}/${name}`, one);
  };
  const { actor, ...start } = plan.start;
  parts.set('@start.', String(actor));
  element('@start', start);
  for (const [name, one] of Object.entries(plan.actors)) element(name, one);
  for (const [name, one] of Object.entries(plan.configuration))
    parts.set(`$${name}`, JSON.stringify(one));
  return parts;
}

const strip = (/** @type {Page} */ page) => page.getByRole('region', { name: /^Compared with/ });
const marked = (/** @type {Page} */ page) =>
  page
    .locator('[data-diff]')
    .evaluateAll((all) =>
      all
        .map((one) => `${one.getAttribute('data-diff-kind')} ${one.getAttribute('data-diff')}`)
        .sort(),
    );

/** @param {Studio} studio @param {string} other */
async function compareWith({ page, command, press }, other) {
  await command('Compare the plan with…');
  await seen(page.getByRole('menuitem', { name: other }));
  await until(`${other} has the keyboard`, async () => {
    // The menu itself has all of their names.
    const now = await page.evaluate(() => {
      const { activeElement: focus } = document;
      return focus?.getAttribute('role') === 'menuitem' ? (focus.textContent ?? '') : '';
    });
    if (now.includes(other)) return true;
    await press('ArrowDown');
    return false;
  });
  await press('Enter');
  await seen(strip(page));
}

const project = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(
      t,
      { name: 'Compare', plan: 'P.plan.json', world: 'room.world.json', target: 'sim' },
      {
        'room.world.json': text(room),
        'P.plan.json': text(kPlan),
        ...Object.fromEntries(versions.map((one, at) => [`V${at}.plan.json`, text(one)])),
      },
    ),
};

test('the drawing marks exactly what differs', project, async (studio) => {
  const { page, place, layout, press } = studio;
  await layout('Draw');
  await page.getByRole('tab', { name: 'Project' }).click();
  const tree = page.getByRole('tree');
  for (const [at, now] of versions.entries()) {
    await tree.getByRole('treeitem', { name: `V${at}.plan` }).dblclick();
    await seen(page.getByRole('tab', { name: new RegExp(`V${at}`), selected: true }));
    for (const [from, before] of versions.entries()) {
      if (from === at) continue;
      await compareWith(studio, `V${from}.plan.json`);
      const wanted = expected(before, now);
      await until(`V${at} shows what differs from V${from}`, async () => {
        const shown = await marked(page);
        return JSON.stringify(shown) === JSON.stringify(wanted);
      }).catch(async (error) => {
        error.message += `\nwanted ${wanted.join(', ')}\nshown  ${(await marked(page)).join(', ')}`;
        throw error;
      });
      // The list is that of the command line.
      const words = ['plan', 'diff', '--json', `V${from}.plan.json`, `V${at}.plan.json`];
      const { stdout } = spawnSync(vagusProgram, words, { cwd: place, encoding: 'utf8' });
      const count = JSON.parse(stdout).length;
      await strip(page).getByRole('button', { name: 'All differences' }).click();
      const rows = page.getByRole('list', { name: 'All differences' }).getByRole('button');
      assert.equal(await rows.count(), count);
      await press('Escape');
      await gone(strip(page));
    }
  }
  assert.deepEqual(await marked(page), []);
});

test('a file that changed on disk is compared by keys, and left', project, async (studio) => {
  const { page, place, layout, press } = studio;
  await layout('Draw');
  await page.getByRole('group', { name: /^hold, actor/ }).focus();
  await press('Space', 'Delete');
  const theirs = copy(kPlan);
  theirs.actors.say.in.text = 'word & word';
  // The same lines: otherwise both would be put together.
  theirs.actors.hold.template = 'Stubborn';
  writeFileSync(join(place, 'P.plan.json'), text(theirs));
  await press('Control+s');
  const notice = page.getByRole('status').filter({ hasText: 'changed on disk' });
  await seen(notice);
  await notice.getByRole('button', { name: 'Show differences' }).focus();
  await press('Enter');
  await seen(strip(page));
  await reads(strip(page), /Compared with the file on disk[^]*≠\s*1\s*changed[^]*−\s*2\s*removed/);
  await seen(page.getByRole('img', { name: 'hold: removed' }));
  await look(studio, 'compare');
  // One after the other, each with what was and what is; the Properties panel shows the same one.
  await press('F7');
  await reads(strip(page), /1 of 3/);
  for (let more = 0; more < 2; ++more) {
    const line = await strip(page).locator('.pcompare__line').innerText();
    if (line.includes('in.text')) break;
    await press('F7');
  }
  await reads(strip(page), /actor say, in\.text[^]*word & word[^]*→[^]*word/);
  await seen(
    page.getByRole('region', { name: 'Properties' }).getByRole('heading', { name: 'say' }),
  );
  await press('Shift+F7', 'F7');
  await reads(strip(page), /in\.text/);
  // What is taken back is no difference any more.
  await page.getByRole('group', { name: /^say, actor/ }).focus();
  await press('Control+z');
  await reads(strip(page), /≠\s*2\s*changed/);
  await press('Escape');
  await gone(strip(page));
  assert.deepEqual(await marked(page), []);
});

test(
  'the other version is followed: another plan, and the file when it is saved',
  project,
  async (studio) => {
    const { page, place, layout, press } = studio;
    await layout('Draw');
    await seen(page.getByRole('group', { name: /^hold, actor/ }));
    await compareWith(studio, 'V1.plan.json');
    await reads(strip(page), /≠\s*\d+\s*changed/);
    writeFileSync(join(place, 'V1.plan.json'), text(kPlan));
    await reads(strip(page), /No difference/);
    await press('Escape');
    await page.getByRole('group', { name: /^hold, actor/ }).focus();
    await press('Space', 'Delete');
    await compareWith(studio, 'The file on disk');
    await reads(strip(page), /−\s*\d+\s*removed/);
    await press('Control+s');
    await reads(strip(page), /No difference/);
  },
);

test('a commit, and the version that runs, are compared', project, async (studio) => {
  const { page, place, layout, press } = studio;
  const git = (/** @type {string[]} */ ...words) =>
    execFileSync(
      'git',
      [
        '-c',
        'user.name=Ada',
        '-c',
        'user.email=ada@example.org',
        '-c',
        'commit.gpgsign=false',
        ...words,
      ],
      { cwd: place },
    );
  await layout('Draw');
  await compareWith(studio, 'The file on disk');
  await reads(strip(page), /No difference/);
  await press('Escape');
  git('init', '--quiet');
  git('add', 'P.plan.json');
  git('commit', '--quiet', '--no-verify', '-m', 'The first plan');
  await page.getByRole('group', { name: /^hold, actor/ }).focus();
  await press('Space', 'Delete');
  await compareWith(studio, 'The first plan');
  await reads(strip(page), /Compared with “The first plan” \([0-9a-f]{7}\)/);
  await seen(page.getByRole('img', { name: 'hold: removed' }));
  await press('Escape');
  await page.getByRole('group', { name: /^say, actor/ }).focus();
  await press('Control+z', 'Control+s');
  await page.getByRole('switch', { name: 'What it does' }).click();
  const live = page.getByRole('complementary', { name: 'What the plan does' });
  await live.getByRole('button', { name: 'Start' }).click();
  await reads(live, /step 1 of the run/);
  await page.getByRole('group', { name: /^hold, actor/ }).focus();
  await press('Space', 'Control+d');
  const before = page.getByRole('status').filter({ hasText: 'Saving changes the running plan' });
  await before.getByRole('button', { name: 'Show differences' }).focus();
  await press('Enter');
  await reads(strip(page), /Compared with the version that runs[^]*\+\s*1\s*added/);
  await seen(page.getByRole('img', { name: 'hold2: added' }));
  await page.getByRole('group', { name: /^say, actor/ }).focus();
  // Taken over, nothing differs.
  await press('Control+s');
  await reads(strip(page), /No difference/);
});
