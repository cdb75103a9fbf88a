// Looks with axe at each view in both themes; a serious finding is a failure.
import { readFileSync } from 'node:fs';
import { openStudio } from './browser.mjs';
import { breakLine, openWorld, pauseAt, showRobot } from './views.mjs';

const source = readFileSync(
  new URL('../node_modules/axe-core/axe.min.js', import.meta.url),
  'utf8',
);
const layout = (name) => async (page) => void (await page.getByRole('radio', { name }).click());
const views = {
  start: { project: false },
  folder: {
    project: false,
    prepare: async (page) => void (await page.keyboard.press('Control+o')),
  },
  'new project': {
    project: false,
    prepare: async (page) => void (await page.keyboard.press('Alt+n')),
  },
  script: { prepare: breakLine },
  'script with bytecode': {
    prepare: async (page) =>
      void (await page.getByRole('button', { name: 'Bytecode beside the text' }).first().click()),
  },
  draw: { prepare: layout('Draw') },
  debug: { prepare: async (page, server) => (await layout('Debug')(page), pauseAt(server, 34)) },
  present: { prepare: layout('Present') },
  world: { prepare: openWorld },
  'world live': {
    prepare: async (page) => {
      await page.keyboard.press('F5');
      await openWorld(page);
      await page.getByRole('radio', { name: 'Live' }).click();
      await page.getByRole('button', { name: 'carbot', exact: true }).click();
      await page.keyboard.press('F8');
    },
  },
  plan: {
    prepare: async (page) => {
      await page
        .getByRole('treeitem', { name: /WallFollow/ })
        .first()
        .dblclick();
      await page.getByRole('button', { name: 'Start', exact: true }).click();
      await page.waitForTimeout(1000);
      await page.keyboard.press('F8');
    },
  },
  palette: { prepare: async (page) => void (await page.keyboard.press('Control+k')) },
  keys: { prepare: async (page) => void (await page.keyboard.press('F1')) },
  search: { prepare: async (page) => void (await page.keyboard.press('Control+Shift+f')) },
  settings: { prepare: async (page) => void (await page.keyboard.press('Control+,')) },
  robot: {
    prepare: async (page) => {
      await showRobot(page, 'Script');
      await page.getByRole('button', { name: 'Send…' }).click();
    },
  },
  'robot in tables': {
    prepare: async (page) => {
      await showRobot(page, 'Script');
      await page.getByRole('button', { name: 'Counts' }).click();
      await page.getByRole('button', { name: 'As a table' }).click();
    },
  },
  watch: {
    prepare: async (page, server) => (await showRobot(page, 'Debug'), pauseAt(server, 34)),
  },
  network: {
    prepare: async (page) => {
      await showRobot(page, 'Network');
      await page.getByRole('button', { name: /^drive 1,/ }).click();
    },
  },
  'many nodes': { crowd: 96, prepare: (page) => showRobot(page, 'Network') },
  target: {
    prepare: async (page) => void (await page.getByRole('button', { name: /^Target/ }).click()),
  },
};

let serious = 0;
const wanted = process.argv.slice(2).filter((one) => !one.startsWith('--'));
for (const theme of ['dark', 'light'])
  for (const [name, view] of Object.entries(views)) {
    if (wanted.length > 0 && !wanted.includes(name)) continue;
    const { page, server, problems, close } = await openStudio({
      project: view.project ?? true,
      crowd: view.crowd ?? 0,
      theme,
    });
    await page.waitForTimeout(900);
    await view.prepare?.(page, server);
    await page.waitForTimeout(500);
    // The page's policy lets no script in from elsewhere: it is put there by the browser's own hand.
    const found = await page.evaluate(
      `${source}; axe.run(document, { resultTypes: ['violations'] }).then((result) => result.violations.map(({ id, impact, help, nodes }) => ({ id, impact, help, nodes: nodes.slice(0, 3).map((node) => node.html.slice(0, 160) + ' ' + node.any.map((one) => one.message).join(' ').slice(0, 200)) })))`,
    );
    for (const one of found) {
      const grave = one.impact === 'serious' || one.impact === 'critical';
      if (grave) serious++;
      if (grave || process.argv.includes('--all'))
        console.log(
          `${theme} ${name}: ${one.impact} ${one.id}: ${one.help}\n    ${one.nodes.join('\n    ')}`,
        );
    }
    for (const problem of problems) console.log(`${theme} ${name}: ${problem}`);
    await close();
  }
console.log(serious === 0 ? 'axe: nothing serious' : `axe: ${serious} serious`);
process.exit(serious === 0 ? 0 : 1);
