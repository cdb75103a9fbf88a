// A plan that runs, on its drawing: breakpoints, what it counts, where it is paused.
import assert from 'node:assert/strict';
import { makeProject } from './support/robots.mjs';
import { gone, reads, seen, test } from './support/studio.mjs';
/** @import { Page, TestContext } from './support/studio.mjs' */

const kRounds = `{
  "format": "vagus-plan/1",
  "name": "Rounds",
  "configuration": {
    "n": { "type": "int", "initial": 0 },
    "limit": { "type": "int", "initial": 1000000 }
  },
  "start": {
    "actor": "say",
    "supervisors": {
      "late": { "template": "Timeout", "in": { "seconds": 1000 }, "events": { "Timeout": "@terminate" } }
    }
  },
  "actors": {
    "say": { "template": "Log", "in": { "text": "'round ' & n" }, "states": { "Done": "rest" } },
    "rest": { "template": "Wait", "in": { "seconds": 0.1 }, "states": { "Done": "count" } },
    "count": { "template": "For", "in": { "counter": "n", "last": "limit" }, "out": { "counter": "n" },
      "states": { "Loop": "say", "Done": "@terminate" } }
  },
  "layout": { "say": [0, 160], "rest": [320, 160], "count": [640, 160], "@start": [0, 0], "@configuration": [0, 320] }
}
`;
const kWorld = JSON.stringify({
  format: 'vagus-world/1',
  name: 'Room',
  size: [3, 3],
  robots: [{ name: 'alice', type: 'thymio2', at: [0.5, 0.5], node: 1 }],
});
const rounds = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(
      t,
      { name: 'Rounds', plan: 'Rounds.plan.json', world: 'room.world.json', target: 'sim' },
      { 'Rounds.plan.json': kRounds, 'room.world.json': kWorld },
    ),
};
const element = (/** @type {Page} */ page, /** @type {string} */ name) =>
  page.getByRole('group', { name, exact: false });
const shows = (/** @type {Page} */ page) =>
  page.getByRole('list', { name: 'Breakpoints' }).getByRole('listitem');

test('a breakpoint by the keyboard stops the plan, which says so', rounds, async (studio) => {
  const { page, press, layout, command } = studio;
  await layout('Draw');
  await element(page, 'count, computation For').focus();
  await press('Space', 'F9');
  await seen(element(page, 'count, computation For').getByRole('img', { name: 'Breakpoint' }));
  await press('F5');
  await seen(page.getByText('Paused by the breakpoint count'));
  // It is paused before its third actor: one say, one rest, and no count yet.
  await reads(element(page, 'say, actor Log'), /×1 0\.0 s/);
  await reads(element(page, 'rest, actor Wait'), /×1 0\.1 s/);
  await command('Breakpoints');
  await reads(shows(page), /count\s+Rounds\.plan\s+paused here\s+1 hit/);
  await press('F5');
  await reads(element(page, 'rest, actor Wait'), /×2 0\.2 s/);
  await reads(shows(page), /paused here\s+2 hits/);
  await page.getByRole('switch', { name: 'count: On' }).click();
  await press('F5');
  await reads(shows(page), /off/);
  await gone(page.getByText('Paused by the breakpoint count'));
  await press('Shift+F5');
});

test('a state stops at its Nth hit; it is set by the menu and its form', rounds, async (studio) => {
  const { page, press, layout } = studio;
  await layout('Draw');
  const count = element(page, 'count, computation For');
  await count.getByTitle('Loop').first().click({ button: 'right' });
  await page.getByRole('menuitem', { name: 'Plan: breakpoint at the selection' }).click();
  await seen(count.getByRole('img', { name: 'Breakpoint' }));
  await page.getByLabel('from hit').fill('3');
  await press('Enter');
  await seen(count.getByRole('img', { name: 'Breakpoint, from hit 3' }));
  await press('F5');
  await seen(page.getByText('Paused by the breakpoint count · Loop'));
  // Three loops: n is 3, and the next say gives it.
  await reads(element(page, 'n, variable, int'), /3/);

  await press('Shift+F5');
});

test('breakpoints follow a renaming, and come back with undo', rounds, async (studio) => {
  const { page, press, type, layout, command } = studio;
  await layout('Draw');
  await element(page, 'count, computation For').focus();
  await press('Space', 'F9');
  await command('Breakpoints');
  await reads(shows(page), /count/);
  await element(page, 'count, computation For').focus();
  await press('F2');
  await type('again');
  await press('Enter');
  await reads(shows(page), /again/);
  await element(page, 'again, computation For').focus();
  await press('Control+z');
  await reads(shows(page), /count/);
  await press('Control+y');
  await reads(shows(page), /again/);
  await seen(element(page, 'again, computation For').getByRole('img', { name: 'Breakpoint' }));
});

test('a condition stops the plan, and an event is raised by hand', rounds, async (studio) => {
  const { page, press, layout, command, button } = studio;
  await layout('Draw');
  await element(page, 'say, actor Log').click();
  await command('Breakpoints');
  await page.getByLabel('Stop when').fill('n == 4');
  await press('Enter', 'F5');
  await seen(page.getByText('Paused by the breakpoint when n == 4'));
  await reads(element(page, 'n, variable, int'), /4/);
  const late = element(page, 'late, supervisor Timeout');
  await late.focus();
  await press('Space');
  await command('Properties');
  await button('Raise Timeout').click();
  await gone(page.getByRole('contentinfo', { name: 'What works now' }));
  await reads(late, /×1/);
});

test('what the formulas gave is below the drawing', rounds, async (studio) => {
  const { page, press, layout } = studio;
  await layout('Draw');
  await element(page, 'rest, actor Wait').focus();
  await press('F5');
  const line = page.getByLabel('What works now');
  await reads(line, /rest\s+step \d+ of the run\s+seconds 0\.1 s/);
  await press('Shift+F5');
});

test(
  'from an actor to the line of its script on the node, and back',
  { words: ['--example', 'follow-wall'] },
  async (studio) => {
    const { page, press, layout, editor } = studio;
    await layout('Draw');
    const actor = element(page, 'searchFirstWall, actor Forward');
    await actor.focus();
    await press('Space', 'F12');
    await seen(editor('drive'));
    await seen(page.locator('.cm-activeLine', { hasText: 'onevent drive.forward' }));
    await page.getByRole('tab', { name: /WallFollow/ }).click();
    await actor.focus();
    await press('F9', 'F5');
    await seen(page.getByText('Paused by the breakpoint searchFirstWall'));
    await actor.focus();
    await press('Control+F10');
    await reads(page.getByRole('contentinfo', { name: 'State' }), /drive paused at line \d+/);
    await seen(page.locator('.cm-standing'));
    await page.getByRole('button', { name: 'Show searchFirstWall' }).click();
    await seen(actor);
    // The breakpoint that led there is nobody's.
    await studio.command('Breakpoints');
    await reads(shows(page), /searchFirstWall/);
    assert.equal(await shows(page).count(), 1);
  },
);
