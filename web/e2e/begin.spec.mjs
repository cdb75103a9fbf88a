// A plan that is paused before an actor begins.
import { makeProject } from './support/robots.mjs';
import { reads, seen, test } from './support/studio.mjs';
/** @import { TestContext } from './support/studio.mjs' */

const kPlan = JSON.stringify({
  format: 'vagus-plan/1',
  name: 'P',
  configuration: { n: { type: 'float', initial: 3 } },
  start: { actor: 'wait' },
  actors: {
    wait: { template: 'Wait', in: { seconds: 'n / 10' }, states: { Done: 'second' } },
    second: { template: 'Wait', in: { seconds: 'n * 20' }, states: { Done: '@terminate' } },
  },
  layout: { wait: [80, 96], second: [80, 240] },
});
const kWorld = JSON.stringify({
  format: 'vagus-world/1',
  name: 'W',
  size: [1, 1],
  ground: { colour: [1, 1, 1] },
  objects: [],
  robots: [{ name: 'r', type: 'thymio2', at: [0.5, 0.5] }],
});
const prepare = (/** @type {TestContext} */ t) =>
  makeProject(
    t,
    { name: 'B', plan: 'P.plan.json', world: 'w.world.json' },
    { 'P.plan.json': kPlan, 'w.world.json': kWorld },
  );

test('an actor that has not begun shows what it will take', { prepare }, async (studio) => {
  const { page, layout, press } = studio;
  await layout('Draw');
  await page.getByRole('group', { name: /^second, actor/ }).focus();
  await press('Space', 'F9');
  await page.getByRole('switch', { name: 'What it does' }).click();
  await press('F5');
  await seen(page.getByText('Paused by the breakpoint second'));
  const ahead = 'seconds = n * 20 s · n 3';
  await seen(page.locator('.pactive').getByText(ahead));
  await seen(page.getByRole('complementary', { name: 'What the plan does' }).getByText(ahead));
  // Once it has begun: what its formula gave.
  await press('F5');
  await reads(page.locator('.pactive'), /seconds 60 s/);
});
