// A plan tried by hand, without a robot: who tries it chooses how each actor ends and which supervisor
// raises. By keyboard alone, and by clicks in the drawing.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { look } from './support/axe.mjs';
import { makeProject } from './support/robots.mjs';
import { vagusProgram } from './support/server.mjs';
import { focused, gone, reads, seen, test, until } from './support/studio.mjs';
/** @import { Page, Studio, TestContext } from './support/studio.mjs' */

const text = (/** @type {unknown} */ value) => `${JSON.stringify(value, null, 2)}\n`;

const kPlan = {
  format: 'vagus-plan/1',
  name: 'Hall',
  configuration: { rounds: { type: 'int', initial: 0 } },
  start: {
    actor: 'drive',
    supervisors: {
      over: { template: 'Timeout', in: { seconds: 900 }, events: { Timeout: '@terminate' } },
    },
  },
  actors: {
    drive: {
      template: 'Wait',
      in: { seconds: 10 },
      states: { Done: 'count' },
      supervisors: {
        near: { template: 'Timeout', in: { seconds: 5 }, events: { Timeout: 'nap' } },
      },
    },
    count: {
      template: 'Assign',
      in: { value: 'rounds + 1' },
      out: { result: 'rounds' },
      states: { Done: 'drive' },
    },
    nap: { plan: 'Nap.plan.json', states: { OK: 'drive', Interrupted: 'drive', Error: 'drive' } },
  },
  layout: { drive: [120, 120], count: [420, 120], nap: [420, 320] },
};
const kNap = {
  format: 'vagus-plan/1',
  name: 'Nap',
  start: { actor: 'sleep' },
  actors: { sleep: { template: 'Wait', in: { seconds: 2 }, states: { Done: '@terminate' } } },
};
const project = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(
      t,
      { name: 'Try', plan: 'Hall.plan.json' },
      { 'Hall.plan.json': text(kPlan), 'Nap.plan.json': text(kNap) },
    ),
};

const kWorld = {
  format: 'vagus-world/1',
  name: 'Hall',
  seed: 1,
  size: [3, 2],
  robots: [{ name: 'thymio', type: 'thymio2', at: [1, 1], angle: 0 }],
};
const running = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(
      t,
      { name: 'Try', plan: 'Hall.plan.json', world: 'hall.world.json', target: 'sim' },
      {
        'Hall.plan.json': text(kPlan),
        'Nap.plan.json': text(kNap),
        'hall.world.json': text(kWorld),
      },
    ),
};

const bar = (/** @type {Page} */ page) => page.getByRole('region', { name: 'Try' });
const lane = (/** @type {Page} */ page) =>
  page.getByRole('list', { name: 'The way so far' }).getByRole('button');
const value = (/** @type {Page} */ page) => page.getByRole('group', { name: /^rounds, variable/ });

/** By the palette: nothing needs a mouse. @param {Studio} studio */
async function tries({ page, layout, command }) {
  await layout('Draw');
  await seen(page.getByRole('group', { name: /^drive, actor/ }));
  await command('Try the plan by hand');
  await reads(bar(page), /drive is active\. How does it end\?/);
  await focused(bar(page));
}

test('a plan is tried by keys, and its way becomes a test', project, async (studio) => {
  const { page, press, place } = studio;
  await tries(studio);
  await look(studio, 'try');
  assert.equal(await page.locator('.pactor.is-active').getAttribute('data-plan-actor'), 'drive');
  // A state by its number: the computation computes.
  await press('1');
  await reads(value(page), /rounds\s*1/);
  await reads(bar(page), /drive is active/);
  // An event by arrows and Enter: into the sub-plan.
  const raise = bar(page).getByRole('button', { name: /near: Timeout/ });
  await until('the event has the keyboard', async () => {
    if (await raise.evaluate((one) => one === document.activeElement)) return true;
    await press('ArrowRight');
    return false;
  });
  await press('Enter');
  await reads(bar(page), /sleep is active\. How does it end\?/);
  assert.equal(await page.locator('.pactor.is-active').getAttribute('data-plan-actor'), 'nap');
  await press('1');
  await reads(bar(page), /drive is active/);
  await until('the lane shows the way', async () => {
    const names = await lane(page).evaluateAll((all) => all.map((one) => one.textContent));
    return (
      names.join('; ') ===
      ['drive Done', 'drive near.Timeout', 'nap/sleep Done', 'drive '].join('; ')
    );
  });
  // Taken back and chosen again.
  await press('Backspace');
  await reads(bar(page), /sleep is active/);
  // On a French keyboard this key types a digit with Shift only.
  await bar(page).dispatchEvent('keydown', { key: '&', code: 'Digit1' });
  await reads(bar(page), /drive is active/);
  // The test passes, and is open.
  const keep = bar(page).getByRole('button', { name: 'Keep as a test' });
  await keep.focus();
  await press('Enter');
  await seen(page.getByRole('tab', { name: /Hall\.test/, selected: true }));
  const kept = JSON.parse(readFileSync(join(place, 'Hall.test.json'), 'utf8'));
  assert.deepEqual(kept.expect[0], { order: ['drive', 'drive', 'nap/sleep', 'drive'] });
  assert.match(
    execFileSync(vagusProgram, ['test', 'Hall.test.json'], { cwd: place, encoding: 'utf8' }),
    /1 of 1|passed|ok/i,
  );
});

test('a plan is tried by clicks in the drawing, to its end', project, async (studio) => {
  const { page, press } = studio;
  await tries(studio);
  await page.locator('[data-plan-row="drive.Done"] span').click();
  await reads(value(page), /rounds\s*1/);
  await page.getByRole('group', { name: /^near, supervisor/ }).click();
  await reads(bar(page), /sleep is active/);
  // Back by the lane.
  await lane(page).first().click();
  await reads(bar(page), /drive is active/);
  await reads(value(page), /rounds\s*0/);
  await page.getByRole('group', { name: /^over, supervisor/ }).click();
  await reads(bar(page), /The plan was interrupted\./);
  await bar(page).getByRole('button', { name: 'Take back the last choice' }).click();
  await reads(bar(page), /drive is active/);
  await press('Escape');
  await gone(bar(page));
  assert.equal(await page.locator('.pactor.is-active').count(), 0);
  // Digits typed before it is there, and before an answer is, are for what comes: into the sub-plan and out of it.
  await studio.command('Try the plan by hand');
  await press('3', '1', '1');
  await reads(value(page), /rounds\s*1/);
  await reads(bar(page), /drive is active/);
});

const kAsking = {
  format: 'vagus-plan/1',
  name: 'Ask',
  configuration: { far: { type: 'int', initial: 0 } },
  start: { actor: 'ask' },
  actors: {
    ask: {
      template: 'Receive',
      in: { event: "'distance'" },
      out: { arg0: 'far' },
      states: { Received: 'ask' },
    },
  },
};
const asking = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(t, { name: 'Try', plan: 'Ask.plan.json' }, { 'Ask.plan.json': text(kAsking) }),
};

test('what an actor gives is typed, and is in the test', asking, async (studio) => {
  const { page, press, type, layout, command, place } = studio;
  await layout('Draw');
  await seen(page.getByRole('group', { name: /^ask, actor/ }));
  await command('Try the plan by hand');
  await reads(bar(page), /ask is active/);
  const field = bar(page).getByRole('textbox', { name: 'arg0' });
  await field.focus();
  // Keys that choose elsewhere are typed here.
  await type('1x');
  assert.equal(await field.getAttribute('aria-invalid'), 'true');
  await press('Backspace');
  await type('2');
  await press('Shift+Tab', 'Enter');
  const far = page.getByRole('group', { name: /^far, variable/ });
  await reads(far, /far\s*12/);
  assert.equal(await field.inputValue(), '');
  await look(studio, 'try outputs');
  await bar(page).getByRole('button', { name: 'Keep as a test' }).click();
  await seen(page.getByRole('tab', { name: /Ask\.test/, selected: true }));
  const kept = JSON.parse(readFileSync(join(place, 'Ask.test.json'), 'utf8'));
  assert.deepEqual(kept.answers.ask[0], { after: 1, state: 'Received', out: { arg0: 12 } });
});

test('a sub-plan that another program changes is tried as it is then', project, async (studio) => {
  const { page, press, place } = studio;
  await tries(studio);
  await press('3');
  await reads(bar(page), /sleep is active[^]*Done/);
  const sleep = { template: 'Receive', in: { event: "'x'" }, states: { Received: '@terminate' } };
  writeFileSync(join(place, 'Nap.plan.json'), text({ ...kNap, actors: { sleep } }));
  await reads(bar(page), /sleep is active[^]*Received/);
});

test(
  'what runs and what ran is shown in place of a plan that is tried',
  running,
  async (studio) => {
    const { page, press } = studio;
    await tries(studio);
    await press('1');
    await reads(lane(page).first(), /drive\s*Done/);
    await press('F5');
    await gone(bar(page));
    await seen(page.getByRole('button', { name: /Running/ }));
    await press('F8');
    await studio.command('Try the plan by hand');
    // As far as it was.
    await reads(lane(page).first(), /drive\s*Done/);
    await press('Alt+F10');
    await seen(page.getByRole('region', { name: 'Looking back' }));
    await gone(bar(page));
    await studio.command('Try the plan by hand');
    await gone(page.getByRole('region', { name: 'Looking back' }));
    await reads(lane(page).first(), /drive\s*Done/);
  },
);

test('an edited plan is tried as it is now', project, async (studio) => {
  const { page, press } = studio;
  await tries(studio);
  await press('1');
  await reads(value(page), /rounds\s*1/);
  // What was chosen still fits; then it does not.
  await page.getByRole('group', { name: /^count, computation/ }).focus();
  await press('Space', 'Delete');
  await seen(
    bar(page)
      .getByRole('alert')
      .filter({ hasText: /leads nowhere/ }),
  );
  await page.getByRole('group', { name: /^Start/ }).focus();
  await press('Control+z');
  await reads(bar(page), /drive is active/);
});
