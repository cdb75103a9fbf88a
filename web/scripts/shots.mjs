// Pictures of the views, for the eyes of who works on them: node scripts/shots.mjs [view…] [--light] [--size=WxH]
import { mkdirSync } from 'node:fs';
import { openStudio } from './browser.mjs';
import { breakLine, openWorld, pauseAt, showRobot } from './views.mjs';

const wanted = process.argv.slice(2).filter((one) => !one.startsWith('--'));
const theme = process.argv.includes('--light') ? 'light' : 'dark';
const [width, height] = (
  process.argv.find((one) => one.startsWith('--size='))?.slice(7) ?? '1440x900'
)
  .split('x')
  .map(Number);
mkdirSync('shots', { recursive: true });

const views = {
  start: { project: false },
  script: {
    async prepare(page) {
      await breakLine(page);
    },
  },
  run: {
    async prepare(page) {
      await page.keyboard.press('F5');
      await page.waitForTimeout(700);
    },
  },
  draw: {
    async prepare(page) {
      await page.getByRole('radio', { name: 'Draw' }).click();
      await page.waitForTimeout(500);
    },
  },
  debug: {
    async prepare(page, server) {
      await page.getByRole('radio', { name: 'Debug' }).click();
      await page.waitForTimeout(300);
      pauseAt(server, 34);
      await page.waitForTimeout(500);
    },
  },
  present: {
    async prepare(page) {
      await page.getByRole('radio', { name: 'Present' }).click();
      await page.waitForTimeout(300);
    },
  },
  world: {
    async prepare(page) {
      await openWorld(page);
    },
  },
  'world-edit-robot': {
    async prepare(page) {
      await openWorld(page);
      await page.getByRole('button', { name: 'carbot', exact: true }).click();
      await page.waitForTimeout(300);
    },
  },
  'world-live': {
    async prepare(page) {
      await page.keyboard.press('F5');
      await openWorld(page);
      await page.getByRole('radio', { name: 'Live' }).click();
      await page.waitForTimeout(4000);
      await page.getByRole('button', { name: 'carbot', exact: true }).click();
      await page.waitForTimeout(400);
    },
  },
  'world-3d': {
    async prepare(page) {
      await page.keyboard.press('F5');
      await openWorld(page);
      await page.getByRole('radio', { name: 'Live' }).click();
      await page.getByRole('button', { name: 'In 3D' }).first().click();
      await page.waitForTimeout(6000);
    },
  },
  'world-present': {
    async prepare(page) {
      await page.keyboard.press('F5');
      await page.getByRole('radio', { name: 'Present' }).click();
      await page.waitForTimeout(3000);
    },
  },
  'world-draw': {
    async prepare(page) {
      await page.keyboard.press('F5');
      await page.getByRole('radio', { name: 'Draw' }).click();
      await page.waitForTimeout(3000);
    },
  },
  plan: {
    async prepare(page, server) {
      await page.getByRole('radio', { name: 'Draw' }).click();
      server.model.plan.began = -9;
      await page.waitForTimeout(500);
      await page.getByRole('button', { name: 'Start', exact: true }).click();
      await page.waitForTimeout(2500);
    },
  },
  palette: {
    async prepare(page) {
      await page.keyboard.press('Control+k');
      await page.keyboard.type('lay');
    },
  },
  keys: {
    async prepare(page) {
      await page
        .getByRole('tree')
        .focus()
        .catch(() => {});
      await page.keyboard.press('F1');
      await page.waitForTimeout(300);
    },
  },
  search: {
    async prepare(page) {
      await page.keyboard.press('Control+Shift+f');
      await page.waitForTimeout(1200);
      await page.keyboard.type('accepted');
      await page.keyboard.press('Enter');
      await page.waitForTimeout(300);
    },
  },
  settings: {
    async prepare(page) {
      await page.keyboard.press('Control+,');
      await page.waitForTimeout(400);
    },
  },
  menu: {
    async prepare(page) {
      await page.getByRole('button', { name: /^Target/ }).click();
      await page.waitForTimeout(200);
    },
  },
  folder: {
    project: false,
    async prepare(page) {
      await page.keyboard.press('Control+o');
      await page.waitForTimeout(400);
    },
  },
  robot: { prepare: (page) => showRobot(page, 'Script') },
  'robot-paused': {
    async prepare(page, server) {
      await showRobot(page, 'Debug');
      await page.waitForTimeout(500);
      pauseAt(server, 34);
      await page.waitForTimeout(500);
    },
  },
  'plots-present': { prepare: (page) => showRobot(page, 'Present') },
  network: { crowd: 0, prepare: (page) => showRobot(page, 'Network') },
  'robot-tables': {
    async prepare(page) {
      await showRobot(page, 'Script');
      await page.getByRole('button', { name: 'Send…' }).click();
      await page.getByRole('button', { name: 'Counts' }).click();
      await page.getByRole('button', { name: 'As a table' }).click();
    },
  },
  'network-chosen': {
    async prepare(page) {
      await showRobot(page, 'Network');
      await page.getByRole('button', { name: /^drive 1,/ }).click();
      await page.mouse.move(400, 700);
    },
  },
  'network-1': {
    async prepare(page, server) {
      server.model.nodes = server.model.nodes.slice(0, 1);
      await showRobot(page, 'Network');
    },
  },
  'network-20': { crowd: 16, prepare: (page) => showRobot(page, 'Network') },
  'network-100': { crowd: 96, prepare: (page) => showRobot(page, 'Network') },
  complete: {
    async prepare(page) {
      await page.getByRole('textbox', { name: /Script of drive/ }).click();
      await page.keyboard.press('Control+End');
      await page.keyboard.type('\nonevent tick\n    if ac');
      await page.waitForTimeout(600);
    },
  },
  listing: {
    async prepare(page) {
      await page.getByRole('button', { name: 'Bytecode beside the text' }).first().click();
      await page.waitForTimeout(500);
    },
  },
};

for (const name of wanted.length ? wanted : Object.keys(views)) {
  const view = views[name];
  const { page, server, problems, close } = await openStudio({
    project: view.project ?? true,
    crowd: view.crowd ?? 0,
    width,
    height,
    theme,
  });
  try {
    await page.waitForTimeout(900);
    await view.prepare?.(page, server);
    await page.screenshot({ path: `shots/${name}-${theme}-${width}x${height}.png` });
  } catch (error) {
    problems.push(String(error).slice(0, 300));
    await page.screenshot({ path: `shots/${name}-failed.png` });
  }
  if (problems.length) console.log(name, problems);
  await close();
}
