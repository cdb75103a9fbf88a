// Each sample plan is drawn again through the interface, from an empty canvas, and does the same.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { atEnd, root, vagusProgram } from './support/server.mjs';
import { seen, test, until } from './support/studio.mjs';
/** @import { Studio, TestContext } from './support/studio.mjs' */

/** The plan of a shared library needs that library built: its templates are tested elsewhere. */
const samples = [
  ['embed', 'Greet'],
  ['find-object', 'DriveToObject'],
  ['follow-object', 'FollowRobot'],
  ['follow-wall', 'WallFollow'],
  ['infrared', 'DriveToBeacon'],
  ['obstacle', 'AroundObstacle'],
  ['patterns', 'FigureOfEight'],
  ['patterns', 'Square'],
  ['rooms', 'DriveTo'],
  ['rooms', 'EnterRoom'],
  ['rooms', 'GoToRoom'],
  ['traffic-light', 'TrafficLight'],
];
/** So much of each run is compared, in its own time. */
const kSeconds = 20;

const readJson = (/** @type {string} */ path) => JSON.parse(readFileSync(path, 'utf8'));
const writeJson = (/** @type {string} */ path, /** @type {any} */ value) =>
  writeFileSync(path, `${JSON.stringify(value, null, 2)}\n`);

/** A copy of the examples in which that plan is empty. */
function emptied(/** @type {string} */ folder, /** @type {string} */ name) {
  return (/** @type {TestContext} */ t) => {
    const place = mkdtempSync(join(tmpdir(), 'vagus-samples-'));
    atEnd(t, () => rmSync(place, { recursive: true }));
    cpSync(join(root, 'examples'), place, { recursive: true });
    const here = join(place, folder);
    const file = join(here, `${name}.plan.json`);
    writeJson(file, { format: 'vagus-plan/1', name, actors: {} });
    const project = readJson(join(here, 'vagus.json'));
    writeJson(join(here, 'vagus.json'), { ...project, plan: `${name}.plan.json` });
    return { words: [here], here, file };
  };
}

function traceOf(/** @type {string} */ here, /** @type {string} */ file) {
  const { world } = readJson(join(here, 'vagus.json'));
  const words = ['plan', 'run', file, '--clock', 'virtual', '--seed', '1', '--trace', '-'];
  if (world) words.push('--world', join(here, world));
  for (const toolbox of readJson(join(here, 'vagus.json')).toolboxes ?? [])
    words.push('--toolbox', join(here, toolbox));
  words.push('--max-time', String(kSeconds));
  try {
    return execFileSync(vagusProgram, words, {
      encoding: 'utf8',
      stdio: ['ignore', 'pipe', 'pipe'],
    });
  } catch (problem) {
    const ended = /** @type {{ stdout: string, stderr: string }} */ (problem);
    // A run that is cut has an exit status of its own.
    return ended.stdout || ended.stderr;
  }
}

/** The first line in which two traces differ. */
function firstOther(/** @type {string} */ trace, /** @type {string} */ wanted) {
  const [ours, theirs] = [trace.split('\n'), wanted.split('\n')];
  const at = theirs.findIndex(
    (/** @type {any} */ line, /** @type {number} */ index) => line !== ours[index],
  );
  return at < 0 && ours.length === theirs.length ? '' : `${ours[at]}\ninstead of\n${theirs[at]}`;
}

/** What a person does to draw a plan, in the order of its file. */
class Drawing {
  constructor(/** @type {Studio} */ { page, press }, /** @type {any} */ plan) {
    this.page = page;
    this.press = press;
    this.plan = plan;
    this.form = page.getByRole('region', { name: 'Properties' });
  }

  async all() {
    const { configuration = {}, actors, start } = this.plan;
    for (const [name, variable] of Object.entries(configuration))
      await this.variable(name, variable);
    for (const [name, actor] of Object.entries(actors)) {
      await this.element(name, actor, () => this.addActor(actor));
      for (const [one, supervisor] of Object.entries(actor.supervisors ?? {}))
        await this.supervisor(name, one, supervisor);
    }
    for (const [one, supervisor] of Object.entries(start.supervisors ?? {}))
      await this.supervisor('Start', one, supervisor);
    await this.choose('Start');
    await this.leads({ 'first actor': start.actor });
    // Only now is all there that they may lead to.
    for (const [name, actor] of Object.entries(actors)) {
      await this.choose(name);
      await this.leads(actor.states ?? {});
      for (const [one, { events }] of Object.entries(actor.supervisors ?? {})) {
        await this.choose(one);
        await this.leads(events ?? {});
      }
    }
    for (const [one, { events }] of Object.entries(start.supervisors ?? {})) {
      await this.choose(one);
      await this.leads(events ?? {});
    }
  }

  /** The element of that name, wherever it is. */
  async choose(/** @type {string} */ name) {
    await this.page.locator('.pcanvas').click({ position: { x: 300, y: 4 } });
    await this.press('Control+f');
    if (name === 'Start') {
      await this.press('Escape');
      const start = this.page.getByRole('group', { name: /^Start/ });
      await start.focus();
      return this.press('Space');
    }
    await this.page.getByRole('combobox', { name: 'Find in the plan' }).fill(name);
    await this.press('Enter');
    await seen(this.form.getByRole('heading', { name, exact: true }));
  }

  async rename(/** @type {string} */ to) {
    await this.form.getByRole('button', { name: 'Rename' }).click();
    await this.form.getByRole('textbox', { name: 'Name' }).fill(to);
    await this.press('Enter');
    await seen(this.form.getByRole('heading', { name: to, exact: true }));
  }

  async fill(/** @type {string} */ label, /** @type {string} */ text, within = this.form) {
    const field = within.getByLabel(label, { exact: true });
    await field.fill(text);
    await this.press('Enter');
  }

  async variable(
    /** @type {string} */ name,
    /** @type {Record<string, string>} */ { type, initial, unit, access },
  ) {
    await this.page.getByRole('button', { name: 'New variable' }).click();
    await this.rename(name);
    await this.form.getByLabel('Type').selectOption(type);
    await this.fill('Initial value', initial === undefined ? '' : String(initial));
    if (unit !== undefined) await this.fill('Unit', unit);
    if (access !== undefined) await this.form.getByLabel('For callers').selectOption(access);
  }

  async tool(/** @type {string} */ name, /** @type {any} */ kinds) {
    const search = this.page.getByRole('searchbox', { name: /Search \d+ templates/ });
    await search.fill(name);
    const group = this.toolboxOf(name, kinds);
    await this.page
      .getByRole('region', { name: group, exact: true })
      .getByRole('button', { name: new RegExp(`^${name}, (${kinds})$`) })
      .click();
    await search.fill('');
  }

  /** The one that the plan lists, if it has the template; else core. */
  toolboxOf(/** @type {string} */ name, /** @type {any} */ kinds) {
    const listed = (this.plan.toolboxes ?? []).filter((/** @type {any} */ one) => one !== 'core');
    return kinds !== 'sub-plan' && !kCore.has(name) && listed[0] !== undefined ? listed[0] : 'core';
  }

  async addActor(/** @type {{ template?: string, plan?: string }} */ { template, plan }) {
    if (template !== undefined) return this.tool(template, 'actor|computation');
    await this.page.getByRole('button', { name: `${plan}, sub-plan` }).click();
  }

  async element(/** @type {string} */ name, /** @type {any} */ element, /** @type {any} */ add) {
    await add();
    await this.rename(name);
    const inputs = this.form.getByRole('region', { name: 'Inputs' });
    const outputs = this.form.getByRole('region', { name: 'Outputs' });
    for (const [input, formula] of Object.entries(element.in ?? {}))
      await this.fill(
        input,
        typeof formula === 'string' ? formula : JSON.stringify(formula),
        inputs,
      );
    for (const [output, variable] of Object.entries(element.out ?? {}))
      await outputs.getByRole('combobox', { name: output, exact: true }).selectOption(variable);
  }

  async supervisor(
    /** @type {any} */ owner,
    /** @type {string} */ name,
    /** @type {any} */ supervisor,
  ) {
    await this.choose(owner);
    await this.element(name, supervisor, () => this.tool(supervisor.template, 'supervisor'));
  }

  async leads(/** @type {Record<string, any>} */ targets) {
    for (const [outcome, target] of Object.entries(targets))
      await this.form
        .getByRole('region', { name: /^(States|Events|Begins with)$/ })
        .getByRole('combobox', { name: outcome, exact: true })
        .selectOption(target);
  }
}

const kCore = new Set(
  [
    'Wait',
    'WaitForever',
    'Log',
    'Fail',
    'Stubborn',
    'Send',
    'Receive',
    'Assign',
    'Compare',
    'For',
  ].concat(['Random', 'Timeout', 'Every', 'Watch', 'OnEvent']),
);

for (const [folder, name] of samples) {
  test(`${folder}/${name} is drawn again`, { prepare: emptied(folder, name) }, async (studio) => {
    const { page, layout, press, here, file } = studio;
    const original = join(root, 'examples', folder, `${name}.plan.json`);
    const plan = readJson(original);
    await layout('Draw');
    await seen(page.getByRole('region', { name: `Plan ${name}, drawn` }));
    await new Drawing(studio, plan).all();
    await press('Control+s');
    const drawn = await until('all of it is saved', () => {
      const now = readJson(file);
      const count = (/** @type {any} */ one) => Object.keys(one.actors).length;
      return count(now) === count(plan) && now.start?.actor === plan.start.actor && now;
    });
    assert.deepEqual(Object.keys(drawn.actors), Object.keys(plan.actors));
    await until('it is in the form of vagus plan format', () => {
      execFileSync(vagusProgram, ['plan', 'format', '--check', file], { stdio: 'ignore' });
      return true;
    });
    const wanted = traceOf(join(root, 'examples', folder), original);
    assert.ok(existsSync(file) && wanted.length > 0);
    assert.equal(firstOther(traceOf(here, file), wanted), '');
  });
}
