// Events of the bus that wait while a plan is paused, by the keyboard; and those that a paused node drops.
import assert from 'node:assert/strict';
import { look } from './support/axe.mjs';
import { makeProject } from './support/robots.mjs';
import { gone, reads, seen, test } from './support/studio.mjs';
/** @import { Page, Studio, TestContext } from './support/studio.mjs' */

// Waits for go, then for on, then for end.
const kThree = JSON.stringify({
  format: 'vagus-plan/1',
  name: 'Three',
  start: { actor: 'first' },
  actors: {
    first: { template: 'Receive', in: { event: "'go'" }, states: { Received: 'second' } },
    second: { template: 'Receive', in: { event: "'on'" }, states: { Received: 'third' } },
    third: { template: 'Receive', in: { event: "'end'" }, states: { Received: '@terminate' } },
  },
});
const kScript = `<network>
<event size="0" name="go"/>
<event size="1" name="on"/>
<event size="0" name="end"/>
<keywords flag="true"/>
<node nodeId="1" name="thymio-II">
var heard = 0
onevent go
	heard += 1
</node>
</network>
`;
const kWorld = JSON.stringify({
  format: 'vagus-world/1',
  name: 'Room',
  size: [3, 3],
  robots: [{ name: 'alice', type: 'thymio2', at: [0.5, 0.5], node: 1, script: 'robot.aesl' }],
});
const three = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(
      t,
      {
        name: 'Three',
        plan: 'Three.plan.json',
        scripts: ['robot.aesl'],
        world: 'room.world.json',
        target: 'sim',
      },
      { 'Three.plan.json': kThree, 'room.world.json': kWorld, 'robot.aesl': kScript },
    ),
};
const element = (/** @type {Page} */ page, /** @type {string} */ name) =>
  page.getByRole('group', { name, exact: false });
const held = (/** @type {Page} */ page) =>
  page.getByRole('list', { name: 'Held events' }).getByRole('listitem');

/** Sends events by the panel, and shows those that wait again. */
async function send(/** @type {Studio} */ { page, command }, /** @type {string[]} */ ...names) {
  await command('Send an event…');
  const form = page.getByRole('form', { name: 'Send an event' });
  for (const name of names) {
    await form.getByRole('combobox').selectOption(name);
    if (name === 'on') await form.getByRole('textbox').fill('7');
    await form.getByRole('button', { name: 'Send' }).click();
    await seen(page.getByText(`${name} was sent`).last());
  }
  await command('Breakpoints');
}

/** The plan has heard go, and is paused before its second actor; the held events are shown. */
async function standAtSecond(/** @type {Studio} */ studio) {
  const { page, press, layout } = studio;
  await layout('Draw');
  await element(page, 'second, actor Receive').focus();
  await press('Space', 'F9', 'F5');
  await seen(page.getByRole('button', { name: /Running/ }));
  await send(studio, 'go');
  await seen(page.getByText('Paused by the breakpoint second'));
  await seen(page.getByText('No events since.'));
}

test('held events are dropped, let go and stepped with, by the keyboard', three, async (studio) => {
  const { page, press, command } = studio;
  await standAtSecond(studio);
  await send(studio, 'end', 'on', 'go');
  await reads(held(page).first(), /end/);
  assert.equal(await held(page).count(), 3);
  await reads(held(page).nth(1), /a host\s+on \[7\]/);
  await look(studio, 'held events');
  // The plan would hear end too early, and wait for it forever.
  await page.getByRole('button', { name: 'Drop end' }).focus();
  await press('Enter');
  await reads(held(page).first(), /on \[7\]/);
  await command('Held events: step with the first');
  await reads(page.getByRole('contentinfo', { name: 'What works now' }), /third/);
  await reads(held(page).first(), /go/);
  await command('Held events: drop all');
  await seen(page.getByText('No events since.'));
  await send(studio, 'end');
  await page.getByRole('button', { name: 'Release end' }).focus();
  await press('Enter');
  await seen(page.getByText('No events since.'));
  await press('F5');
  await gone(page.getByRole('heading', { name: 'Held events' }));
});

test('a paused node says how many events it has dropped', three, async (studio) => {
  const { page, press, layout, editor } = studio;
  await layout('Script');
  await seen(editor('thymio-II'));
  await editor('thymio-II').focus();
  await press('Control+End', 'ArrowUp', 'F9', 'F5');
  await seen(page.getByRole('button', { name: /Running/ }));
  await send(studio, 'go');
  await reads(page.getByRole('contentinfo', { name: 'State' }), /thymio-II paused at line \d+/);
  await send(studio, 'go', 'go', 'end');
  // Its script has no handler of end: nothing is lost by that.
  await seen(page.getByText('thymio-II is paused and has dropped 2 events of its own.'));
  await look(studio, 'dropped events');
});
