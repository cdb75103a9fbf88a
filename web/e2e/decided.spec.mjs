// When was it decided? Chance is planted at an instant that is known: it is found, looked at, and both
// continuations are opened.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { look } from './support/axe.mjs';
import { aesl, makeProject } from './support/robots.mjs';
import { vagusProgram } from './support/server.mjs';
import { gone, reads, seen, test, until } from './support/studio.mjs';
/** @import { Page, Studio, TestContext } from './support/studio.mjs' */

// The tenth tick, one second after the start, draws a number. Half of them turn the robot on the spot four
// seconds later; with the others it drives into the wall, 0.9 m away.
const script = `var ticks = 0
var coin = 0
timer.period[0] = 100
motor.left.target = 400
motor.right.target = 400

onevent timer0
ticks++
if ticks == 10 then
call math.rand(coin)
end
if ticks == 50 and coin < 0 then
motor.left.target = -100
motor.right.target = 100
end
`;
const room = {
  format: 'vagus-world/1',
  name: 'Room',
  size: [2, 2],
  robots: [{ name: 'thymio', type: 'thymio2', at: [1, 1], node: 1, script: 'go.aesl' }],
};
const planted = {
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(
      t,
      { name: 'Coin', world: 'room.world.json', scripts: ['go.aesl'] },
      { 'go.aesl': aesl({ 'thymio-II': script }), 'room.world.json': JSON.stringify(room) },
    ),
};

const bar = (/** @type {Page} */ page) => page.getByRole('region', { name: 'Looking back' });
const clock = async (/** @type {Page} */ page) =>
  parseFloat(await page.locator('.clock__time').innerText());
const found = (/** @type {Page} */ page) =>
  page.getByRole('region', { name: 'When was it decided?' });

/** Runs so long. */
async function run(/** @type {Studio} */ { page, press, layout }, /** @type {number} */ seconds) {
  await layout('Debug');
  await press('F5');
  await until(`${seconds} s of the run`, async () => (await clock(page)) > seconds);
  await press('F8');
  await seen(page.getByRole('button', { name: 'Continue' }));
}

test('the coin was thrown long before it fell', planted, async (studio) => {
  const { page, press, type, place } = studio;
  await run(studio, 11);
  // By keys alone: the command, the condition, the answer.
  await press('Control+k');
  await type('when was it decided');
  await press('Enter');
  const condition = page.getByRole('textbox', { name: 'Condition' });
  await until('the keyboard is there', () =>
    condition.evaluate((is) => is === document.activeElement),
  );
  await look(studio, 'asking when it was decided');
  await page.getByLabel('Tries').selectOption('10');
  await condition.focus();
  await type('contact >= 2');
  await press('Enter');
  await seen(page.getByRole('progressbar', { name: 'Continuations' }));
  // Some four hundred continuations.
  await found(page).waitFor({ timeout: 100_000 });
  const sentence = await found(page)
    .getByText(/^it turned between/)
    .innerText();
  const [, before = '', after = ''] = /between ([\d.]+) s and ([\d.]+) s/.exec(sentence) ?? [];
  // Ticks come each 100 ms of the run: the tenth about a second after its first.
  assert.ok(Math.abs(Number(after) - 1) < 0.05, sentence);
  assert.ok(Number(after) - Number(before) < 0.0011, sentence);
  await reads(found(page), /the script of thymio-II called math\.rand/);
  await look(studio, 'when it was decided');
  // The same as numbers, each an instant.
  await found(page).getByText('Numbers').click();
  const rows = found(page).getByRole('row');
  assert.ok((await rows.count()) > 10);
  await found(page)
    .getByRole('button', { name: `Look at ${after} s` })
    .focus();
  await press('Enter');
  await reads(bar(page), new RegExp(`Everything shows ${after} s`));
  await press('Escape');
  await gone(bar(page));
  // Both continuations are there, and say the same of themselves.
  const kept = (/** @type {string} */ which) => join(place, '.vagus/turning-point', which);
  const names = execFileSync('ls', [kept('.')], { encoding: 'utf8' })
    .trim()
    .split('\n')
    .sort();
  assert.equal(names.length, 2);
  for (const name of names) {
    assert.ok(existsSync(kept(name)));
    assert.match(
      execFileSync(vagusProgram, ['replay', kept(name)], { encoding: 'utf8' }),
      /no difference/,
    );
  }
  await found(page)
    .getByRole('button', { name: 'Open a continuation in which it does not' })
    .click();
  await until('it is at its end', async () => (await clock(page)) >= 11);
  await reads(found(page), /This was asked of a run before this one\./);
  assert.ok(
    await found(page)
      .getByRole('button', { name: `Look at ${after} s` })
      .isDisabled(),
  );
});

test('what cannot be asked says why, and a search can be stopped', planted, async (studio) => {
  const { page, press, command } = studio;
  await run(studio, 3);
  await command('When was it decided?');
  const condition = page.getByRole('textbox', { name: 'Condition' });
  await condition.fill('contakt >= 2');
  await press('Enter');
  await reads(page.getByRole('alert'), /contakt/);
  await condition.fill('x > 100');
  await page.getByLabel('Tries').selectOption('100');
  await condition.focus();
  await press('Enter');
  await page
    .getByRole('form', { name: 'When was it decided?' })
    .getByRole('button', { name: 'Stop' })
    .click();
  await seen(page.getByText('Stopped.'));
  // Chance does not lead out of the room.
  await page.getByLabel('Tries').selectOption('10');
  await condition.focus();
  await press('Enter');
  await reads(found(page), /not decided by chance: it became true in none of \d+ continuations/);
});
