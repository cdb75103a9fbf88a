// The debugger over several nodes: run, break, step, faults, and nodes that come and go.
import assert from 'node:assert/strict';
import { makeProject, startNode, twoNodes } from './support/robots.mjs';
import { boxOf, reads, seen, test, until } from './support/studio.mjs';
/** @import { Page, Studio, TestContext } from './support/studio.mjs' */

const scripts = {
  left: `var n = 0
timer.period = 50
onevent timer
n = n + 1
emit tick n`,
  right: `var sum = 0
var last
onevent tick
last = args[0]
sum = sum + last
`,
};
const two = {
  prepare: (/** @type {TestContext} */ t) => twoNodes(t, scripts, { events: { tick: 1 } }),
};

const row = (/** @type {Page} */ page, /** @type {string} */ name) =>
  page.getByRole('row', { name: new RegExp(`^(Choose )?${name}`) });
/** What the tab of a node's script says with its three signs. */
const mark = (
  /** @type {Studio} */ studio,
  /** @type {string} */ node,
  /** @type {string | RegExp} */ words,
) => studio.tab(new RegExp(`^${node} \\d`)).getByRole('img', { name: words });
const stateOf = (/** @type {Page} */ page, /** @type {string} */ name) =>
  row(page, name).getByRole('cell').nth(1);

test('each node runs, pauses, steps and stops by itself, and all together', two, async (studio) => {
  const { page, press, button, command } = studio;
  await seen(studio.editor('left'));
  await command('Show Network');
  await seen(page.getByRole('group', { name: 'The bus with 2 nodes' }));
  await press('F5');
  await reads(stateOf(page, 'left'), /running/);
  await reads(stateOf(page, 'right'), /running/);
  await seen(page.getByRole('row', { name: /left tick right \d+/ }));
  await button('Pause: right').click();
  await reads(stateOf(page, 'right'), /paused/);
  await reads(stateOf(page, 'left'), /running/);
  await button('Step: right').click();
  await reads(stateOf(page, 'right'), /paused/);
  await button('Run: right').click();
  await reads(stateOf(page, 'right'), /running/);
  await seen(mark(studio, 'right', /, running$/));
  await button('Pause: All nodes').click();
  await reads(stateOf(page, 'left'), /paused/);
  await reads(stateOf(page, 'right'), /paused/);
  await seen(mark(studio, 'left', /paused/));
  await press('Shift+F5');
  await reads(stateOf(page, 'left'), /stopped/);
  await reads(stateOf(page, 'right'), /stopped/);
  await button('Run: left').click();
  await reads(stateOf(page, 'left'), /running/);
});

test(
  'a breakpoint with a condition stops one node; it is kept and given back',
  two,
  async (studio) => {
    const { page, press, editor, tab, button, right } = studio;
    await seen(editor('left'));
    await press('F5');
    await seen(mark(studio, 'right', /, running$/));
    await tab(/right 2/).click();
    await editor('right').click();
    await press('Control+Home', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'Control+F9');
    await page.getByLabel('Stops if').fill('args[0] % 10 == 0');
    await press('Enter');
    await seen(page.getByText('right paused at line 4'));
    await seen(page.getByText('if args[0] % 10 == 0'));
    await reads(page.locator('.cm-values'), /args(\[0\])? = \d*0\b/);
    await studio.layout('Debug');
    await seen(page.getByRole('list', { name: 'Breakpoints' }).getByText(/[1-9]\d* hits?/));
    // The other one was not asked to pause.
    await seen(mark(studio, 'left', /, running$/));

    // Unplugged: it is said, and nothing has to be answered.
    await right.program.stop();
    await seen(mark(studio, 'right', /stopped/));
    assert.equal(await page.getByRole('alertdialog').count(), 0);
    const again = await startNode(studio.t, 'right', 2, right.port);
    assert.equal(again.port, right.port);
    // Plugged in: script and breakpoint are back; it is paused until a page lets it run.
    await seen(mark(studio, 'right', /[^t] on the robot, (paused|stopped)/));
    await tab(/right 2/).click();
    await button('Run this node').click();
    await seen(page.getByText('right paused at line 4'));
    await reads(page.locator('.cm-values'), /args(\[0\])? = \d*0\b/);
    // After the studio has gone and come back the breakpoint is there, too.
    await page.reload();
    await seen(page.getByRole('list', { name: 'Breakpoints' }).getByText(/right:4/));
  },
);

const faulty = {
  prepare: (/** @type {TestContext} */ t) =>
    twoNodes(
      t,
      { left: 'var zero = 0\nvar x\nonevent go\nx = 1\nx = 5 / zero\n', right: '' },
      {
        events: { go: 0 },
      },
    ),
};
test('a fault is shown at the line that caused it', faulty, async (studio) => {
  const { page, press, editor, command } = studio;
  await seen(editor('left'));
  await press('F5');
  await seen(mark(studio, 'left', /, running$/));
  await command('Send an event…');
  await page.getByRole('button', { name: 'Send', exact: true }).click();
  await seen(page.getByText(/The node stopped at line 5: .*/));
  await seen(page.getByText('left paused at line 5'));
});

const day = {
  format: 'vagus-plan/1',
  name: 'Day',
  start: { actor: 'rise' },
  actors: {
    rise: { template: 'Wait', in: { seconds: 0.1 }, states: { Done: 'nap' } },
    nap: {
      plan: 'Nap.plan.json',
      states: { OK: '@terminate', Interrupted: '@terminate', Error: '@terminate' },
    },
  },
};
const nap = {
  format: 'vagus-plan/1',
  name: 'Nap',
  start: { actor: 'doze' },
  actors: {
    doze: { template: 'Wait', in: { seconds: 0.1 }, states: { Done: 'snore' } },
    snore: { template: 'Wait', in: { seconds: 1 }, states: { Done: '@terminate' } },
  },
};
const nested = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(
      t,
      { name: 'Day', plan: 'Day.plan.json', world: 'room.world.json', target: 'sim' },
      {
        'Day.plan.json': JSON.stringify(day),
        'Nap.plan.json': JSON.stringify(nap),
        'room.world.json': JSON.stringify({ format: 'vagus-world/1', size: [2, 2] }),
      },
    ),
};
test('a plan that is paused comes to the front, the innermost one', nested, async (studio) => {
  const { page, press, layout, tab } = studio;
  await layout('Draw');
  const actor = (/** @type {string} */ name) => page.getByRole('group', { name, exact: false });
  const drawn = (/** @type {string} */ name) =>
    page.getByRole('region', { name: `Plan ${name}, drawn` });
  await actor('nap, sub-plan').focus();
  await press('Space', 'o');
  await seen(drawn('Nap'));
  await actor('snore, actor Wait').focus();
  await press('Space', 'F9');
  await seen(actor('snore, actor Wait').locator('.pdot'));
  await layout('Debug');
  await tab(/^Day\.plan/).click();
  await seen(drawn('Day'));
  // Somebody writes at the other side of the window: the keyboard stays there.
  await page.getByRole('tab', { name: 'Watch' }).click();
  const field = page.getByRole('combobox', { name: 'node.variable' });
  await press('F5');
  await field.focus();
  await seen(drawn('Nap'));
  const active = page.locator('.pactor.is-active').filter({ hasText: 'snore' });
  await seen(active);
  assert.equal(await field.evaluate((one) => one === document.activeElement), true);
  // What it may end in is named at any zoom.
  await drawn('Nap').hover();
  const exit = active.locator('.prow > span');
  await until('the drawing is small', async () => {
    await page.mouse.wheel(0, 400);
    return (await boxOf(active)).width < 90;
  });
  await page.mouse.move(5, 5);
  assert.equal(await exit.evaluate((one) => getComputedStyle(one).opacity), '1');
  const other = page.locator('.pactor').filter({ hasText: 'doze' }).locator('.prow > span');
  assert.equal(await other.evaluate((one) => getComputedStyle(one).opacity), '0');
});
