// Emulated microcontrollers on the desk: a Cortex-M0 and an AVR are programmed, broken into and stepped like any node.
import { aesl, makeProject } from './support/robots.mjs';
import { startProgram, vagusProgram } from './support/server.mjs';
import { seen, test, until } from './support/studio.mjs';
/** @import { Studio, TestContext } from './support/studio.mjs' */

const script = `var n = 0
timer.period = 100
onevent timer
n = n + 1
leds = n
`;

/** `vagus emulate`; gives its port once it listens. */
async function startBoards(/** @type {TestContext} */ t, /** @type {string[]} */ ...boards) {
  const program = startProgram(t, [
    vagusProgram,
    'emulate',
    ...boards,
    '--listen',
    'tcp:127.0.0.1:0',
  ]);
  return Number((await program.line(/^listening tcp:127\.0\.0\.1:(\d+)$/m))[1]);
}

const boards = {
  prepare: async (/** @type {TestContext} */ t) =>
    makeProject(
      t,
      {
        name: 'Boards',
        scripts: ['boards.aesl'],
        target: `tcp:127.0.0.1:${await startBoards(t, 'microbit', 'atmega1284p')}`,
      },
      { 'boards.aesl': aesl({ microbit: script, atmega1284p: script }) },
    ),
};

async function breakAndStep(/** @type {Studio} */ studio, /** @type {string} */ name) {
  const { page, press, editor, tab } = studio;
  const mark = (/** @type {string | RegExp} */ words) =>
    tab(new RegExp(`^${name}`)).getByRole('img', { name: words });
  await tab(new RegExp(`^${name}`)).click();
  await seen(mark(/on the robot, running/));
  await until('it counts', async () => Number(await page.getByTitle('Change n').innerText()) > 3);
  await editor(name).click();
  await press('Control+Home', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'F9');
  await seen(page.getByText(`${name} paused at line 4`));
  const word = async (/** @type {string} */ of) =>
    Number(await page.getByTitle(`Change ${of}`).innerText());
  const before = await word('leds');
  await press('F10');
  await seen(page.getByText(`${name} paused at line 5`));
  // Each pause puts the caret at its line: the keys below come after the last one.
  await press('F10');
  await seen(page.getByText(`${name} paused at line 4`));
  await until('leds is n', async () => {
    const leds = await word('leds');
    return leds > before && leds === (await word('n'));
  });
  await press('F10');
  await seen(page.getByText(`${name} paused at line 5`));
  // Continues: the breakpoint is deleted.
  await press('Control+Home', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'F9', 'F5');
  await seen(mark(/on the robot, running/));
}

test('two emulated boards are programmed, pause and step', boards, async (studio) => {
  await seen(studio.editor('microbit'));
  await studio.press('F5');
  await breakAndStep(studio, 'microbit');
  await breakAndStep(studio, 'atmega1284p');
});
