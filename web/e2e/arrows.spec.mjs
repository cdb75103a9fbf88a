// What tells arrows apart: events interrupt, states end; names at any zoom.
import assert from 'node:assert/strict';
import { makeProject } from './support/robots.mjs';
import { boxOf, reads, seen, test, until } from './support/studio.mjs';
/** @import { TestContext } from './support/studio.mjs' */

/** Two actors that go on for ever, so that the arrow between them is taken while one looks. */
const kPlan = JSON.stringify({
  format: 'vagus-plan/1',
  name: 'P',
  start: { actor: 'one' },
  actors: {
    one: {
      template: 'Wait',
      in: { seconds: 1 },
      states: { Done: 'two' },
      supervisors: {
        late: { template: 'Timeout', in: { seconds: 9 }, events: { Timeout: 'two' } },
      },
    },
    two: { template: 'Wait', in: { seconds: 1000 }, states: { Done: 'one' } },
  },
  layout: { one: [80, 96], two: [480, 240] },
});

const kRoom = JSON.stringify({ format: 'vagus-world/1', size: [2, 2] });

test(
  'events are dashed; a chosen arrow and the one just taken show their names at any zoom',
  {
    prepare: (/** @type {TestContext} */ t) =>
      makeProject(
        t,
        { name: 'A', plan: 'P.plan.json', world: 'room.world.json', target: 'sim' },
        { 'P.plan.json': kPlan, 'room.world.json': kRoom },
      ),
  },
  async ({ page, layout, press }) => {
    await layout('Draw');
    const arrow = (/** @type {string} */ name) => page.getByRole('img', { name, exact: true });
    const dashes = (/** @type {string} */ name) =>
      arrow(name)
        .locator('.parrow__line')
        .evaluate((line) => getComputedStyle(line).strokeDasharray);
    await arrow('one Done leads to two').waitFor({ state: 'attached' });
    assert.equal(await dashes('one Done leads to two'), 'none');
    assert.notEqual(await dashes('one/late Timeout leads to two'), 'none');
    const name = page.locator('.parrow-name');
    assert.equal(await name.count(), 0);
    await arrow('one/late Timeout leads to two').locator('.parrow__hand').dispatchEvent('click');
    await reads(name, 'Timeout');
    const near = await boxOf(name);
    await page.getByRole('region', { name: 'Plan P, drawn' }).hover();
    for (let turns = 0; turns < 12; turns++) await page.mouse.wheel(0, 400);
    await until('the drawing is small', async () => {
      const { width } = await boxOf(page.getByRole('group', { name: /^one, actor Wait/ }));
      return width < 60;
    });
    const far = await boxOf(name);
    assert.ok(far.height >= near.height - 1, `${far.height} px high, ${near.height} px before`);
    await press('F5');
    const taken = page.locator('.parrow-name--taken');
    await reads(taken, 'Done');
    await seen(taken);
    assert.ok((await boxOf(taken)).height >= near.height - 1);
  },
);
