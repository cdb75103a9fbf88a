// Real peers: a Thymio of asebaplayground, alone and behind asebaswitch; and a node's flash.
import { join } from 'node:path';
import { existsSync, writeFileSync } from 'node:fs';
import { startProgram, temporaryFolder } from './support/server.mjs';
import { aesl, freePort, listening, makeProject, startNode } from './support/robots.mjs';
import { reads, seen, test, until } from './support/studio.mjs';
/** @import { Studio, TestContext } from './support/studio.mjs' */

/** asebaplayground with one Thymio II; gives its port. */
async function startPlayground(/** @type {TestContext} */ t) {
  const home = temporaryFolder(t);
  const screen = startProgram(t, [
    'Xvfb',
    '-displayfd',
    1,
    '-screen',
    0,
    '1280x900x24',
    '-nolisten',
    'tcp',
  ]);
  const [, display] = await screen.line(/^(\d+)$/m);
  const port = await freePort();
  const scenario = join(home, 'arena.playground');
  writeFileSync(
    scenario,
    `<!DOCTYPE aseba-playground><aseba-playground><color name="wall" r="0.9" g="0.9" b="0.9"/>
<world w="100" h="100" color="wall"/><wall x="50" y="80" l1="30" l2="2" h="10" color="wall"/>
<robot type="thymio2" x="30" y="50" angle="0" port="${port}" name="t1" nodeId="1"/></aseba-playground>`,
  );
  startProgram(t, ['asebaplayground', scenario], {
    env: {
      DISPLAY: `:${display}`,
      HOME: home,
      XDG_RUNTIME_DIR: home,
      LC_ALL: 'C.UTF-8',
      LIBGL_ALWAYS_SOFTWARE: '1',
    },
  });
  await listening(port);
  return port;
}

async function startForeignSwitch(/** @type {TestContext} */ t, /** @type {number[]} */ ...ports) {
  const port = await freePort();
  startProgram(t, ['asebaswitch', '-p', port, ...ports.map((one) => `tcp:127.0.0.1;${one}`)]);
  await listening(port);
  return port;
}

const script = `var n = 0
onevent prox
n = n + 1
motor.left.target = 100
`;
const project = (/** @type {TestContext} */ t, /** @type {number} */ port) =>
  makeProject(
    t,
    { name: 'Peer', scripts: ['peer.aesl'], target: `tcp:127.0.0.1:${port}` },
    { 'peer.aesl': aesl({ 'thymio-II': script }) },
  );

async function drive(/** @type {Studio} */ studio) {
  const { page, press, editor, tab } = studio;
  // Described: its own variables and its own natives.
  await seen(editor('thymio-II'));
  await seen(page.getByText('prox.horizontal'));
  // Loaded, runs, watched.
  await press('F5');
  await seen(tab(/^thymio-II/).getByRole('img', { name: /on the robot, running/ }));
  const n = page.getByTitle('Change n');
  await until('it counts', async () => Number(await n.innerText()) > 3);
  // Break, step, go on.
  await editor('thymio-II').click();
  await press('Control+Home', 'ArrowDown', 'ArrowDown', 'F9');
  await seen(page.getByText('thymio-II paused at line 3'));
  await press('F10');
  await seen(page.getByText('thymio-II paused at line 4'));
  // Without a breakpoint: each hit stops the wheels of a live robot.
  await press('Control+Home', 'ArrowDown', 'ArrowDown', 'F9', 'F5');
  await page.getByRole('searchbox', { name: 'Find in all nodes' }).fill('motor.left');
  await until(
    'its wheel turns',
    async () => Number(await page.getByTitle('Value of motor.left.speed').innerText()) > 50,
  );
  await press('Shift+F5');
  await reads(page.getByTitle('Change motor.left.target'), '0');
}

test(
  'a Thymio of asebaplayground is driven',
  { prepare: async (t) => project(t, await startPlayground(t)) },
  drive,
);

test(
  'a Thymio behind asebaswitch is driven',
  { prepare: async (t) => project(t, await startForeignSwitch(t, await startPlayground(t))) },
  drive,
);

const flash = {
  async prepare(/** @type {TestContext} */ t) {
    const file = join(temporaryFolder(t), 'kept.abo');
    const node = await startNode(t, 'rover', 3, 0, ['--flash', file]);
    const made = makeProject(
      t,
      { name: 'Flash', scripts: ['rover.aesl'] },
      { 'rover.aesl': aesl({ rover: 'var n = 5\n' }) },
    );
    return { ...made, file, node };
  },
};
test('a target is chosen by its address; the node keeps its program', flash, async (studio) => {
  const { page, button, file, node } = studio;
  await seen(page.getByRole('button', { name: /Target/ }));
  await page.getByRole('button', { name: /^Target/ }).click();
  await page.getByLabel('Address').fill(`tcp:127.0.0.1:${node.port}`);
  await button('Connect').click();
  await seen(page.getByRole('button', { name: /State of the bus: rover/ }));
  await button('Upload').click();
  await seen(page.getByText('rover is on the robot.'));
  await button('Save on the robot').click();
  await seen(page.getByText(/The node keeps its program|saved/));
  await until('the file is there', () => existsSync(file));
  // A target that is not there is said, and nothing waits for an answer.
  await page.getByRole('button', { name: /^Target/ }).click();
  await page.getByRole('button', { name: 'Disconnect' }).click();
  await seen(page.getByRole('button', { name: 'Target No target' }));
});

for (const by of ['mouse', 'keyboard'])
  test(
    `every entry of the menu of targets does something, by ${by}`,
    { words: ['--example', 'thymio'] },
    async ({ page, press, button }) => {
      const target = button(/^Target/);
      const go = async (/** @type {import('playwright-core').Locator} */ one) => {
        if (by === 'mouse') return one.click();
        await one.focus();
        await press('Enter');
      };
      const choose = async (/** @type {string} */ entry) => {
        await go(target);
        const menu = page.getByRole('dialog', { name: /^Target/ });
        await go(menu.getByRole('button', { name: entry, exact: true }));
        return menu;
      };
      await seen(button('Target Simulator'));
      const menu = await choose('Connect');
      await seen(menu.getByRole('alert').filter({ hasText: 'Type an address first' }));
      await until('the field has the focus', () =>
        menu.getByLabel('Address').evaluate((one) => one === document.activeElement),
      );
      await press('Escape');
      await choose('Disconnect');
      await seen(button('Target No target'));
      await choose('Simulator');
      await seen(button('Target Simulator'));
    },
  );
