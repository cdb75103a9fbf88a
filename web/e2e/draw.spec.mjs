// A plan on its canvas: seen, moved, drawn from nothing, connected, renamed, undone.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { makeProject } from './support/robots.mjs';
import { boxOf, focused, gone, reads, seen, test, until } from './support/studio.mjs';
/** @import { Locator, Page, TestContext } from './support/studio.mjs' */

const wall = { words: ['--example', 'follow-wall'] };
const kEmpty = `{
  "format": "vagus-plan/1",
  "name": "P",
  "actors": {}
}
`;
const empty = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(t, { name: 'Empty', plan: 'P.plan.json' }, { 'P.plan.json': kEmpty }),
};
const element = (/** @type {Page} */ page, /** @type {string} */ name) =>
  page.getByRole('group', { name, exact: false });
const arrow = (/** @type {Page} */ page, /** @type {string} */ name) =>
  page.getByRole('img', { name, exact: true });

test(
  'a plan is drawn with its roles and arrows; what is not changed is not saved',
  wall,
  async (studio) => {
    const { page, layout, press, server } = studio;
    await layout('Draw');
    await seen(page.getByRole('region', { name: 'Plan WallFollow, drawn' }));
    await seen(element(page, 'Start, leads to searchFirstWall'));
    await seen(element(page, 'followWall, actor WallForward'));
    await seen(element(page, 'comeCloser, computation Assign'));
    await seen(element(page, 'checkLane, supervisor CheckDrivingLane'));
    await seen(element(page, 'walldist, variable, float'));
    await arrow(page, 'followWall LaneNotFree leads to findWallAngle').waitFor({
      state: 'attached',
    });
    const file = join(server.data, 'projects/follow-wall/follow-wall/WallFollow.plan.json');
    const before = readFileSync(file, 'utf8');
    await element(page, 'followWall, actor').focus();
    await press('Space', 'Control+s');
    assert.equal(readFileSync(file, 'utf8'), before);
  },
);

test(
  'an actor is moved by the keyboard, undone, and the file is as it was',
  wall,
  async (studio) => {
    const { page, layout, press, server, button } = studio;
    await layout('Draw');
    const file = join(server.data, 'projects/follow-wall/follow-wall/WallFollow.plan.json');
    const before = readFileSync(file, 'utf8');
    const actor = element(page, 'followWall, actor');
    await actor.focus();
    await press('Space');
    await seen(page.getByRole('heading', { name: 'followWall' }));
    await press('ArrowRight', 'Control+s');
    // A step of the grid is 8.
    const moved = before.replace('"followWall": [800, 240]', '"followWall": [808, 240]');
    assert.notEqual(moved, before);
    await until('it is saved', () => readFileSync(file, 'utf8') === moved);
    await button('Undo').click();
    await press('Control+s');
    await until('it is as it was', () => readFileSync(file, 'utf8') === before);
  },
);

test('what is removed comes back to each byte', wall, async (studio) => {
  const { page, layout, press, server } = studio;
  await layout('Draw');
  const file = join(server.data, 'projects/follow-wall/follow-wall/WallFollow.plan.json');
  const before = readFileSync(file, 'utf8');
  await element(page, 'followWall, actor').focus();
  await press('Space', 'Delete');
  await gone(element(page, 'followWall, actor'));
  await press('Control+s');
  await until('it is saved', () => !readFileSync(file, 'utf8').includes('"WallForward"'));
  await press('Control+z');
  await seen(element(page, 'followWall, actor'));
  await press('Control+s');
  await until('it is as it was', () => readFileSync(file, 'utf8') === before);
});

test('a plan of two actors is drawn from nothing by the keyboard', empty, async (studio) => {
  const { page, layout, press, place } = studio;
  await layout('Draw');
  await seen(
    page.getByText('Drag an actor here, or type its name in the palette and press Enter.'),
  );
  await seen(page.getByText('Select an element of the plan to see and change its properties.'));
  const search = page.getByRole('searchbox', { name: /Search \d+ templates/ });
  await search.fill('Writes a line');
  await press('Enter');
  await seen(element(page, 'log, actor Log'));
  await search.fill('Waits so long');
  await press('Enter');
  await seen(element(page, 'wait, actor Wait'));
  // The first one is where the plan begins; the others are connected.
  await seen(element(page, 'Start, leads to log'));
  await page.getByRole('button', { name: 'Done leads nowhere: connect to…' }).first().focus();
  await press('Enter');
  await page.getByRole('menuitem', { name: 'wait', exact: true }).click();
  await arrow(page, 'log Done leads to wait').waitFor({ state: 'attached' });
  await page.getByRole('button', { name: 'Done leads nowhere: connect to…' }).focus();
  await press('Enter');
  await page.getByRole('menuitem', { name: 'terminate' }).click();
  await arrow(page, 'wait Done leads to @terminate').waitFor({ state: 'attached' });
  // What it needs: given in the form at the right.
  await element(page, 'wait, actor Wait').focus();
  await press('Enter');
  const form = page.getByRole('region', { name: 'Properties' });
  await form.getByLabel('seconds').fill('1 + 1');
  await press('Enter');
  await element(page, 'log, actor Log').focus();
  await press('Enter');
  await form.getByLabel('text').fill('"hello"');
  await press('Enter');
  await seen(page.getByText('No problems.'));
  await form.getByRole('button', { name: 'Rename' }).click();
  await form.getByRole('textbox', { name: 'Name' }).fill('greet');
  await press('Enter');
  await seen(element(page, 'Start, leads to greet'));
  await press('Control+s');
  const wanted = {
    format: 'vagus-plan/1',
    name: 'P',
    start: { actor: 'greet' },
    actors: {
      greet: { template: 'Log', in: { text: '"hello"' }, states: { Done: 'wait' } },
      wait: { template: 'Wait', in: { seconds: '1 + 1' }, states: { Done: '@terminate' } },
    },
  };
  const saved = await until('it is saved', () => {
    const { layout: places, ...plan } = JSON.parse(
      readFileSync(join(place, 'P.plan.json'), 'utf8'),
    );
    return plan.start?.actor === 'greet' && { plan, places };
  });
  assert.deepEqual(saved.plan, wanted);
  assert.deepEqual(Object.keys(saved.places), ['greet', 'wait']);
});

test('a plan is drawn and corrected with keys alone', empty, async (studio) => {
  const { page, press, type, place } = studio;
  const focused = (/** @type {string} */ what, /** @type {Locator} */ one) =>
    until(`${what} has the focus`, () => one.evaluate((is) => is === document.activeElement));
  const drawing = page.getByRole('region', { name: 'Plan P, drawn' });
  // F6 leads from panel to panel, and in the plan to the drawing.
  const goToPlan = () =>
    until('the plan has the focus', async () => {
      await press('F6');
      return drawing.evaluate((is) => is === document.activeElement);
    });
  await seen(drawing);
  await goToPlan();
  // Another layout leaves the keyboard to the plan.
  for (const name of ['Layout Script', 'Layout Draw']) {
    await press('Control+k');
    await type(name);
    await press('Enter');
    await until('the layout is another', () =>
      page.getByRole('radio', { name: name.replace('Layout ', ''), checked: true }).isVisible(),
    );
    await focused('the plan', drawing);
  }
  // What stands in the list of commands leads to the search.
  await press('Control+k');
  await type('add an element');
  await press('Enter');
  await focused('the search', page.getByRole('searchbox', { name: /Search \d+ templates/ }));
  await type('wait');
  await press('ArrowDown');
  await focused('the first', page.getByRole('button', { name: 'Wait, actor', exact: true }));
  await press('Enter');
  await focused('the actor', element(page, 'wait, actor Wait'));
  // What the bar below offers does what the selected element needs, one after the other.
  await press('Alt+Enter');
  await focused('its input', page.getByRole('combobox', { name: 'seconds' }));
  await type('1 + 1');
  await press('Enter');
  await gone(page.getByRole('button', { name: 'Enter a value' }));
  // The key that draws an arrow is in the list of keys, and asks where the next one leads.
  await goToPlan();
  await press('?');
  await seen(page.getByRole('dialog').getByText('Plan: draw an arrow from the selection…'));
  await press('Escape');
  await focused('the plan', drawing);
  await press('c');
  await seen(page.getByText('Done: connect to…'));
  await press('Escape');
  // At the port, too, Alt+Enter is what fixes.
  await focused('the port', page.getByRole('button', { name: /^Done leads nowhere/ }));
  await press('Alt+Enter');
  await seen(page.getByRole('menuitem', { name: 'terminate' }));
  await type('term');
  await press('Enter');
  await seen(page.getByText('No problems.'));
  await goToPlan();
  await press('Enter');
  await focused('its input', page.getByRole('combobox', { name: 'seconds' }));
  // The start is found as every element is, and its arrow is drawn as theirs are.
  await goToPlan();
  await press('/');
  await type('start');
  await press('Enter');
  await focused('the start', element(page, 'Start, leads to wait'));
  await press('c');
  await seen(page.getByText('Start: connect to…'));
  await press('Escape');
  await press('Control+s');
  await until('it is saved', () => {
    const { actors } = JSON.parse(readFileSync(join(place, 'P.plan.json'), 'utf8'));
    return actors.wait?.in?.seconds === '1 + 1' && actors.wait.states?.Done === '@terminate';
  });
});

test('Alt+Enter on a row of Problems fixes that problem', empty, async (studio) => {
  const { page, press, type } = studio;
  await page.getByRole('region', { name: 'Plan P, drawn' }).focus();
  await press('a');
  await type('wait');
  await press('Enter');
  await focused(element(page, 'wait, actor Wait'));
  // Its input, then its state; the second one is asked for first.
  const row = (/** @type {RegExp} */ what) => page.locator('.virtual__row', { hasText: what });
  await row(/leads nowhere/).focus();
  await press('Alt+Enter');
  await seen(page.getByRole('menuitem', { name: 'terminate' }));
  await type('term');
  await press('Enter');
  await gone(row(/leads nowhere/));
  await row(/needs a value/).focus();
  await press('Alt+Enter');
  await focused(page.getByRole('combobox', { name: 'seconds' }));
});

test(
  'the menu of the empty canvas adds an element',
  wall,
  async ({ page, layout, type, press }) => {
    await layout('Script');
    await page.getByRole('treeitem', { name: /WallFollow/ }).click();
    const canvas = page.getByRole('region', { name: 'Plan WallFollow, drawn' });
    await seen(canvas);
    const { x, y, height } = await boxOf(canvas);
    await page.mouse.click(x + 12, y + height - 12, { button: 'right' });
    await page.getByRole('menuitem', { name: /add an element/ }).click();
    await focused(page.getByRole('searchbox', { name: /Search \d+ templates/ }));
    await type('Writes a line');
    await press('Enter');
    await seen(element(page, 'log, actor Log'));
  },
);

test('supervisors, variables and findings: added, marked, deleted', empty, async (studio) => {
  const { page, layout, press, button } = studio;
  await layout('Draw');
  await button('Wait, actor').click();
  const wait = element(page, 'wait, actor Wait, 2 errors');
  await seen(wait);
  await seen(wait.getByRole('img', { name: '2 errors' }));
  await wait.focus();
  await press('Enter');
  await button('Timeout, supervisor').click();
  await seen(element(page, 'timeout, supervisor Timeout'));
  await button('New variable').click();
  await seen(element(page, 'value, variable, float'));
  const form = page.getByRole('region', { name: 'Properties' });
  await form.getByLabel('Unit').fill('s');
  await press('Enter');
  await reads(element(page, 'value, variable, float'), /0 s/);
  await element(page, 'timeout, supervisor').focus();
  await press('Space', 'Delete');
  await gone(element(page, 'timeout, supervisor'));
  await press('Control+z');
  await seen(element(page, 'timeout, supervisor Timeout'));
});

test(
  'the mouse drags an arrow to its target, and a template onto the plan',
  empty,
  async (studio) => {
    const { page, layout, button } = studio;
    await layout('Draw');
    const canvas = page.getByRole('region', { name: 'Plan P, drawn' });
    await button('Wait, actor').dragTo(canvas, { targetPosition: { x: 160, y: 120 } });
    await seen(element(page, 'wait, actor Wait'));
    await button('Log, actor').dragTo(canvas, { targetPosition: { x: 480, y: 240 } });
    const log = element(page, 'log, actor Log');
    await seen(log);
    const port = element(page, 'wait, actor').getByRole('button', { name: /^Done leads nowhere/ });
    const [from, to] = [await boxOf(port), await boxOf(log)];
    await page.mouse.move(from.x + from.width / 2, from.y + from.height / 2);
    await page.mouse.down();
    await page.mouse.move(to.x + 40, to.y + 20, { steps: 4 });
    await page.mouse.up();
    await arrow(page, 'wait Done leads to log').waitFor({ state: 'attached' });
  },
);

test(
  'elements are chosen together, copied as text, pasted, and taken back',
  wall,
  async (studio) => {
    const { page, layout, press, button } = studio;
    await layout('Draw');
    await element(page, 'followWall, actor').click();
    await element(page, 'parallelToWall, actor').click({ modifiers: ['Control'] });
    await press('Control+c');
    const copied = JSON.parse(await page.evaluate(() => navigator.clipboard.readText()));
    assert.equal(copied.format, 'vagus-plan-part/1');
    assert.deepEqual(Object.keys(copied.actors).sort(), ['followWall', 'parallelToWall']);
    await press('Control+v');
    await seen(element(page, 'followWall2, actor WallForward'));
    await seen(element(page, 'parallelToWall2, actor Turn'));
    // Arrows between the two lead to the copies.
    await arrow(page, 'parallelToWall2 TurnSuccessful leads to followWall2').waitFor({
      state: 'attached',
    });
    // The copies are chosen: both go.
    await press('Delete');
    await gone(element(page, 'followWall2, actor'));
    await gone(element(page, 'parallelToWall2, actor'));
    await button('Undo').click();
    await seen(element(page, 'followWall2, actor'));
    await button('Undo').click();
    await gone(element(page, 'followWall2, actor'));
    await page.evaluate(() => navigator.clipboard.writeText('something else'));
    await element(page, 'Start').focus();
    await press('Control+v');
    await seen(page.getByText('The clipboard has no elements of a plan.'));
  },
);

test('text and drawing are one file', wall, async (studio) => {
  const { page, layout, press } = studio;
  await layout('Draw');
  await page.getByRole('switch', { name: 'Text' }).click();
  const text = page.getByRole('textbox', { name: /Text of/ }).first();
  await text.click();
  await press('Control+f');
  await page.getByLabel('Find', { exact: true }).fill('"keepDistance": {');
  await press('Enter', 'Escape', 'ArrowLeft', 'ArrowRight');
  await seen(element(page, 'keepDistance, computation Assign'));
  await page.keyboard.type('  ');
  await element(page, 'keepDistance, computation').focus();
  await press('Space', 'Delete');
  await gone(element(page, 'keepDistance, computation'));
  await until(
    'the text follows',
    async () => !(await text.innerText()).includes('"keepDistance": {'),
  );
});

test('what a plan does is seen on it', wall, async (studio) => {
  const { page, layout, press } = studio;
  await layout('Draw');
  await seen(element(page, 'searchFirstWall, actor'));
  await press('F5');
  await seen(page.locator('.pactor.is-active'));
  await reads(page.locator('.pactor.is-active'), /\d\.\d s/);
  await seen(page.locator('.psup.is-watching').filter({ hasText: 'escape' }));
  await page.locator('.parrow--taken').waitFor({ state: 'attached' });
  // Who pauses it by hand goes on with what is looked at.
  await studio.tab(/^hall\.world/).click();
  await press('F8');
  await seen(studio.tab(/^WallFollow/).getByRole('img', { name: /paused/ }));
  await seen(page.getByRole('tab', { name: /^hall\.world/, selected: true }));
  await studio.tab(/^WallFollow/).click();
  await press('Shift+F5');
  await gone(page.locator('.pactor.is-active'));
});
