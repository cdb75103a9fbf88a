// The pictures of README.md, from the running program: node scripts/showcase.mjs [view…]
// Each view in both themes as WebP in docs/pictures. A simulation is run by its own clock to a fixed time and is paused
// there, so that a picture changes when the program does.
import { mkdirSync, readdirSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { launchBrowser, owning, pause, root, startServer, until } from './real.mjs';

const kWidth = 1440;
const kHeight = 900;
const kBytesMax = 2_000_000;
const kQuality = 90;
/** So much simulated time passes at once: a trail and a plot have a point for each. */
const kStrideMs = 100;
/** Poses are sent 30 times a second. */
const kStrideWallMs = 40;
const folder = join(root, 'docs/pictures');
/** The same each time: the start screen shows it. */
const home = '/tmp/vagus-pictures';
const kPatienceMs = 3000;
/** Numbers of subscriptions that the page does not use. */
const kOwnWatch = 900_000;

const views = {
  start: {
    words: [],
    async prepare({ page, tell }) {
      // Opened before: what a person who has used it sees.
      for (const id of ['thymio', 'follow-wall']) {
        await tell('project.example', { id });
        await tell('project.close', {});
      }
      await page.getByRole('heading', { name: 'Recent' }).waitFor();
    },
  },
  script: {
    words: ['--example', 'thymio'],
    async prepare(hands) {
      const { page, command } = hands;
      await page.getByRole('radio', { name: 'Script' }).click();
      await hands.runTo(6);
      const editor = page.getByRole('textbox', { name: /^Script of thymio/ });
      await editor.click();
      await command('Find in this text');
      await page.keyboard.type('motor.left.target');
      await page.keyboard.press('Enter');
      await page.keyboard.press('Escape');
      await page.keyboard.press('ArrowRight');
      await page.keyboard.press('Backspace');
      await page.keyboard.press('Backspace');
      await page
        .getByRole('button', { name: /^Write/ })
        .first()
        .waitFor();
    },
  },
  debug: {
    words: ['--example', 'follow-wall'],
    async prepare(hands) {
      await hands.page.getByRole('radio', { name: 'Debug' }).click();
      await hands.watch([
        'drive.odometry.x',
        'drive.token',
        'drive.patience',
        'range.sonar.distance',
      ]);
      await hands.runTo(8);
      const doc = (await hands.parts()).find((part) => part.name === 'drive').doc;
      await hands.tell('break.set', { doc, line: 34 });
      await hands.runTo(20, true);
    },
  },
  world: {
    words: ['--example', 'follow-wall'],
    async prepare(hands) {
      await hands.page.getByRole('radio', { name: 'Present' }).click();
      await hands.plot(['range.sonar.distance', 'drive.odometry.heading']);
      await hands.runTo(20);
    },
  },
  solid: {
    words: ['--example', 'follow-wall'],
    async prepare(hands) {
      await hands.page.getByRole('radio', { name: 'Present' }).click();
      await hands.plot(['range.sonar.distance', 'drive.odometry.heading']);
      await hands.runTo(20);
      await hands.page.getByRole('button', { name: 'In 3D' }).first().click();
      await pause(4000);
    },
  },
  plots: {
    words: ['--example', 'thymio'],
    async prepare(hands) {
      await hands.page.getByRole('radio', { name: 'Present' }).click();
      await hands.plot([
        'thymio-II.prox.horizontal[2]',
        'thymio-II.motor.left.speed',
        'thymio-II.motor.right.speed',
      ]);
      await hands.runTo(12);
    },
  },
  network: {
    words: ['--example', 'follow-wall'],
    async prepare(hands) {
      await hands.page.getByRole('radio', { name: 'Script' }).click();
      await hands.page.getByRole('button', { name: /State of the bus/ }).click();
      await hands.runTo(12);
    },
  },
  plan: {
    words: ['--example', 'follow-wall'],
    async prepare({ page }) {
      await page.getByRole('radio', { name: 'Draw' }).click();
      await page.getByRole('switch', { name: 'Map' }).click();
      await page.getByRole('group', { name: 'followWall, actor WallForward' }).click();
      await page.getByRole('heading', { name: 'followWall' }).waitFor();
    },
  },
  timeline: {
    words: ['--example', 'follow-wall'],
    async prepare(hands) {
      const { page } = hands;
      await page.getByRole('radio', { name: 'Debug' }).click();
      await page.getByRole('tab', { name: 'Timeline' }).click();
      await hands.runTo(40);
      const lanes = page.getByRole('slider', { name: 'Instant that is shown' });
      const { x, y, width } = await lanes.boundingBox();
      await page.mouse.click(x + width * 0.6, y + 8);
      await page.getByRole('region', { name: 'Looking back' }).waitFor();
    },
  },
};

async function take(name, theme) {
  await owning(async (owner) => {
    owner.after(() => rmSync(home, { recursive: true, force: true }));
    mkdirSync(home, { recursive: true });
    const { address } = await startServer(owner, views[name].words, home);
    const context = await browser.newContext({
      viewport: { width: kWidth, height: kHeight },
      colorScheme: theme,
      reducedMotion: 'reduce',
    });
    owner.after(() => context.close());
    const page = await context.newPage();
    try {
      const hands = handsOf(page, await talkTo(page));
      await page.goto(address);
      await page
        .getByText(/^(Take an example|Simulator)$/)
        .first()
        .waitFor();
      await views[name].prepare(hands);
      await page.mouse.move(0, 0);
      await page.evaluate(() => document.activeElement?.blur());
      await page.evaluate(() => document.fonts.ready);
      await pause(700);
      await shoot(page, `${name}-${theme}`);
    } catch (error) {
      failed++;
      console.log(`FAILED ${name}, ${theme}: ${String(error).slice(0, 600)}`);
      await page.screenshot({ path: join('shots', `showcase-${name}.png`) });
    }
  });
}

async function shoot(page, name) {
  const session = await page.context().newCDPSession(page);
  const { data } = await session.send('Page.captureScreenshot', {
    format: 'webp',
    quality: kQuality,
  });
  const bytes = Buffer.from(data, 'base64');
  writeFileSync(join(folder, `${name}.webp`), bytes);
  if (process.argv.includes('--png')) await page.screenshot({ path: `shots/${name}.png` });
  console.log(`${name}.webp: ${(bytes.length / 1000).toFixed(0)} kB`);
}

/** Commands on the page's own connection, so that it keeps control: their numbers are dealt between the page's. */
async function talkTo(page) {
  let socket;
  let next = 1;
  const waiting = new Map();
  const documents = new Map();
  await page.routeWebSocket(/\/live$/, (route) => {
    socket = route.connectToServer();
    route.onMessage((text) => {
      const message = JSON.parse(text);
      const id = next++;
      waiting.set(id, (answer) => route.send(JSON.stringify({ ...answer, id: message.id })));
      socket.send(JSON.stringify({ ...message, id }));
    });
    socket.onMessage((text) => {
      if (typeof text !== 'string') return route.send(text);
      const message = JSON.parse(text);
      if (message.watch >= kOwnWatch) return documents.get(message.watch)?.(message);
      const answer = message.id !== undefined && waiting.get(message.id);
      if (!answer) return route.send(text);
      waiting.delete(message.id);
      answer(message);
    });
  });
  const tell = (what, input) =>
    new Promise((done, fail) => {
      const id = next++;
      waiting.set(id, ({ ok, error }) =>
        error ? fail(new Error(`${what}: ${error.what}`)) : done(ok),
      );
      socket.send(JSON.stringify({ id, do: what, in: input }));
      setTimeout(() => fail(new Error(`${what} was not answered`)), kPatienceMs);
    });
  let watches = kOwnWatch;
  /** The document of a topic as it is, kept true: a function that gives it. */
  const follow = async (topic, of) => {
    const watch = watches++;
    let value;
    documents.set(watch, (message) => {
      value = 'whole' in message ? message.whole : patched(value, message.patch);
    });
    await tell('watch', { watch, topic, ...(of ? { of } : {}) });
    await until(topic, () => value !== undefined);
    return () => value;
  };
  return { tell, follow };
}
function patched(value, patch) {
  if (patch === null || typeof patch !== 'object' || Array.isArray(patch)) return patch;
  const made = { ...(value && typeof value === 'object' && !Array.isArray(value) ? value : {}) };
  for (const [key, part] of Object.entries(patch))
    if (part === null) delete made[key];
    else made[key] = patched(made[key], part);
  return made;
}

function handsOf(page, { tell, follow }) {
  const command = async (title) => {
    await page.keyboard.press('Control+k');
    const field = page.getByRole('combobox', { name: 'Type a command' });
    await field.waitFor();
    await field.fill(title);
    await page.getByRole('option', { name: title }).first().waitFor();
    await page.keyboard.press('Enter');
    await field.waitFor({ state: 'detached' });
  };
  const pick = async (title, field, names) => {
    await command(title);
    const input = page.locator(`[data-find="${field}"]`).first();
    for (const name of names) {
      await input.click();
      await input.fill(name);
      await page
        .locator(`option[value="${name.replace(/\[.*/, '')}"]`)
        .first()
        .waitFor({ state: 'attached' });
      await page.keyboard.press('Enter');
    }
  };
  let clock;
  /** The simulation at that second of its clock, paused; a node that is paused at a breakpoint ends it earlier. */
  const runTo = async (seconds, breaks = false) => {
    clock ??= await follow('clock');
    const robot = breaks && (await follow('robot'));
    if (clock().state !== 'paused' || clock().t === 0) {
      await tell('run.start', {});
      await tell('run.pause', {});
      await until('it pauses', () => clock().state === 'paused');
      await pause(200);
    }
    for (let at = Math.round(clock().t * 1000); at < seconds * 1000;) {
      if (breaks && robot().nodes.some((node) => node.state === 'paused')) return;
      const ms = Math.min(kStrideMs, seconds * 1000 - at);
      // The step before may not be over.
      if (!(await tell('run.step', { ms }).catch(() => null))) continue;
      at += ms;
      await pause(kStrideWallMs);
    }
    await until('time passes', () => clock().t >= seconds - 1e-6);
  };
  return {
    page,
    tell,
    follow,
    command,
    runTo,
    parts: async () => (await follow('scripts'))().parts,
    watch: (names) => pick('Watch a variable', 'watch', names),
    plot: (names) => pick('Plot a variable', 'plots', names),
  };
}

const browser = await launchBrowser();
mkdirSync(folder, { recursive: true });
const wanted = process.argv.slice(2).filter((one) => !one.startsWith('--'));
const only = process.argv.find((one) => one.startsWith('--only='))?.slice(7);
let failed = 0;
for (const name of wanted.length ? wanted : Object.keys(views))
  for (const theme of only ? [only] : ['dark', 'light']) await take(name, theme);
await browser.close();
const total = readdirSync(folder).reduce((sum, one) => sum + statSync(join(folder, one)).size, 0);
console.log(`docs/pictures: ${(total / 1000).toFixed(0)} kB`);
process.exit(failed || total > kBytesMax ? 1 : 0);
