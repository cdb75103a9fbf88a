// A recording that cannot be run again, as that of a real robot, is shown as it was recorded.
import { execFileSync } from 'node:child_process';
import { join } from 'node:path';
import { look } from './support/axe.mjs';
import { makeProject } from './support/robots.mjs';
import { vagusProgram } from './support/server.mjs';
import { gone, reads, seen, test } from './support/studio.mjs';
/** @import { TestContext } from './support/studio.mjs' */

const plan = JSON.stringify({
  format: 'vagus-plan/1',
  name: 'Twice',
  start: { actor: 'first' },
  actors: {
    first: { template: 'Wait', in: { seconds: 2 }, states: { Done: 'second' } },
    second: { template: 'Wait', in: { seconds: 3 }, states: { Done: '@terminate' } },
  },
  layout: { first: [80, 96], second: [320, 96] },
});

/** A plan without a world cannot be run again by the studio either, and needs no robot here. */
function recorded(/** @type {TestContext} */ t) {
  const project = makeProject(t, { name: 'Monday' }, { 'Twice.plan.json': plan });
  const file = join(project.place, 'Twice.plan.json');
  const words = ['plan', 'run', file, '--clock', 'virtual', '--quiet'];
  execFileSync(vagusProgram, [...words, '--record', join(project.place, 'monday.mcap')]);
  return project;
}

test(
  'a recording that cannot be run again is looked at, and asked why',
  { prepare: recorded },
  async (studio) => {
    const { page, layout, button, press } = studio;
    await layout('Draw');
    await page.getByRole('tab', { name: 'Project' }).click();
    await page.locator('[role="treeitem"][data-path="monday.mcap"]').click();
    await seen(
      page.getByText(/^Showing what was recorded, without a run: .*a plan without a world/),
    );
    await seen(page.getByText('Showing monday.mcap.'));
    const active = (/** @type {string} */ name) => seen(button(`Why ${name}?`));
    await active('first');
    await button('To the next step of the plan').click();
    await active('second');
    await button('Why second?').click();
    const why = page.getByRole('tabpanel', { name: 'Why' });
    await reads(why, /the actor second began[^]*the actor first ended with Done/);
    await look(studio, 'the recording and its why');
    await press('Escape');
    await gone(page.getByText('Showing monday.mcap.'));
  },
);
