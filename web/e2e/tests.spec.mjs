// Tests of behaviour in the studio: run, stopped, opened where they failed, and what they went
// through, which is what `vagus test` says of the same files.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { look } from './support/axe.mjs';
import { makeProject } from './support/robots.mjs';
import { restarted, root, vagusProgram } from './support/server.mjs';
import { focused, gone, openWindow, reads, seen, test, until } from './support/studio.mjs';
/** @import { Page, TestContext } from './support/studio.mjs' */

const json = (/** @type {unknown} */ value) => JSON.stringify(value, null, 2);

/** Forward until it is late; what comes behind the way is never reached. */
const ahead = {
  format: 'vagus-plan/1',
  name: 'Ahead',
  toolboxes: ['carbot'],
  configuration: { far: { type: 'float', initial: 1000 } },
  start: {
    actor: 'go',
    supervisors: {
      late: { template: 'Timeout', in: { seconds: 5 }, events: { Timeout: '@terminate' } },
    },
  },
  actors: {
    go: { template: 'Forward', in: { distance: 'far' }, states: { ForwardSuccessful: 'rest' } },
    rest: { template: 'WaitForever' },
  },
  layout: { go: [40, 160], rest: [380, 160] },
};
/** Without a world: it waits twice. */
const pause = {
  format: 'vagus-plan/1',
  name: 'Pause',
  start: { actor: 'first' },
  actors: {
    first: { template: 'Wait', in: { seconds: 1 }, states: { Done: 'second' } },
    second: { template: 'Wait', in: { seconds: 2 }, states: { Done: '@terminate' } },
  },
};
const room = {
  format: 'vagus-world/1',
  name: 'Room',
  seed: 1,
  size: [3, 2],
  robots: [{ name: 'carbot', type: 'carbot', at: [2, 1], angle: 0, script: 'carbot.aesl' }],
};
const inRoom = { format: 'vagus-test/1', plan: 'Ahead.plan.json', world: 'room.world.json' };

const good = json({ ...inRoom, seeds: [1, 3], max_time: 12, expect: [{ eventually: 'x > 2.3' }] });
const bad = json({
  ...inRoom,
  seeds: [1, 2],
  max_time: 12,
  expect: [
    { ends: 'Interrupted', by: 'late' },
    { always: 'x < 2.4', help: 'stays away from the wall' },
  ],
});
/** The node that drives hangs, and the plan ends in an error. */
const hung = json({
  ...inRoom,
  max_time: 12,
  chaos: [{ kind: 'hung', node: 'drive', at: 1 }],
  expect: [{ ends: 'Interrupted', by: 'late' }],
});
const alone = json({
  format: 'vagus-test/1',
  plan: 'Pause.plan.json',
  max_time: 9,
  expect: [{ order: ['first', 'second'] }, { ends: 'OK' }],
});
const broken = '{\n  "format": "vagus-test/1",\n  "plan": 7,\n  "expect": [{ "ends": "OK" }]\n}';
/** It never ends by itself. */
const rest = {
  format: 'vagus-plan/1',
  name: 'Rest',
  start: { actor: 'rest' },
  actors: { rest: { template: 'WaitForever' } },
};
/** Minutes of work, for who stops it. */
const long = json({
  ...inRoom,
  plan: 'Rest.plan.json',
  seeds: [1, 500],
  max_time: 600,
  expect: [{ always: 't >= 0' }],
});
const longTest = { 'Rest.plan.json': json(rest), 'Long.test.json': long };

/** @param {Record<string, string>} tests */
const project = (tests) => ({
  prepare: (/** @type {TestContext} */ t) =>
    makeProject(
      t,
      {
        name: 'Tested',
        plan: 'Ahead.plan.json',
        world: 'room.world.json',
        target: 'sim',
        scripts: ['carbot.aesl'],
      },
      {
        'Ahead.plan.json': json(ahead),
        'Pause.plan.json': json(pause),
        'room.world.json': json(room),
        'carbot.aesl': readFileSync(join(root, 'examples/carbot/carbot.aesl'), 'utf8'),
        ...tests,
      },
    ),
});

const list = (/** @type {Page} */ page) =>
  page.getByRole('list', { name: 'Tests, and what was not as expected' });
const rows = (/** @type {Page} */ page) => list(page).locator('[data-row]');
const said = (/** @type {Page} */ page) => page.locator('.tests__said');
const clock = async (/** @type {Page} */ page) =>
  parseFloat(await page.locator('.clock__time').innerText());

async function openFile(/** @type {Page} */ page, /** @type {string} */ name) {
  const row = page.getByRole('treeitem', { name: new RegExp(`^${name.replaceAll('.', '\\.')}`) });
  await row.focus();
  await row.press('Enter');
  await seen(page.getByRole('textbox', { name: new RegExp(name.replaceAll('.', '\\.')) }));
}

/** What the command line says of all tests of the project. */
function coverageByHand(/** @type {string} */ place) {
  const folder = join(place, '..', 'by-hand');
  mkdirSync(folder);
  execFileSync(vagusProgram, ['test', '.', '--coverage', folder, '--results', folder], {
    cwd: place,
  });
  return (/** @type {string} */ name) => readFileSync(join(folder, name), 'utf8');
}

/** Processes of a program that this computer runs, by what they were started with. */
function processesOf(/** @type {string} */ verb) {
  return readdirSync('/proc')
    .filter((name) => /^\d+$/.test(name))
    .flatMap((pid) => {
      try {
        const words = readFileSync(`/proc/${pid}/cmdline`, 'utf8').split('\0');
        return words[1] === verb ? [pid] : [];
      } catch {
        return []; // it has ended meanwhile
      }
    });
}

test(
  'F5 in a test runs it as it is on the screen; what holds is ok',
  project({ 'Good.test.json': good }),
  async (studio) => {
    const { page, press, type, layout } = studio;
    await layout('Script');
    await openFile(page, 'Good.test.json');
    await focused(page.getByRole('textbox', { name: /Good\.test\.json/ }));
    // Another seed each time, so that what is said of a run is new: its Stop may come and go between two frames.
    const seeds = async (/** @type {string} */ last, /** @type {string} */ next) => {
      await page
        .locator('.cm-line')
        .filter({ hasText: new RegExp(`^\\s*${last}$`) })
        .click();
      await press('End', 'Backspace');
      await type(next);
    };
    // Not saved: a fourth seed.
    await page.getByText('3', { exact: true }).first().waitFor();
    await seeds('3', '4');
    await press('F5');
    await reads(said(page), '4 runs as expected.');
    await reads(rows(page).first(), /ok[^]*Good\.test\.json[^]*4 of 4/);
    await reads(page.getByRole('group', { name: 'Test' }), /ok[^]*4 of 4/);
    // Nothing runs but tests: the simulator is where it was.
    assert.equal(await clock(page), 0);
    await seeds('4', '5');
    await press('Control+k');
    await type('run all tests');
    await press('Enter');
    await reads(said(page), '5 runs as expected.');
    await seeds('5', '6');
    const run = page.getByRole('button', { name: /^Run this test/ });
    await run.focus();
    await press('Enter');
    await reads(said(page), '6 runs as expected.');
    await focused(run);
  },
);

test(
  'what is not as expected has its line, its recording, and is run by hand; by keys alone',
  project({ 'Bad.test.json': bad, 'Good.test.json': good }),
  async (studio) => {
    const { page, press, layout } = studio;
    await layout('Script');
    await openFile(page, 'Bad.test.json');
    await press('F5');
    await reads(said(page), '2 of 2 runs not as expected.');
    const first = rows(page).nth(1);
    await reads(first, /seed 1[^]*s[^]*always "x < 2\.4"[^]*\(stays away from the wall\)/);
    // The line is marked, and says so, in the editor.
    await reads(
      page.locator('.cm-content .diag').last(),
      /2 runs not so; with seed 1, at \d\.\d\d s/,
    );
    await look(studio, 'a test that failed');
    // By keys: down to the failure, its line; right to its recording.
    await rows(page).first().getByRole('button').focus();
    await press('ArrowDown', 'Enter');
    // The second expectation of the file.
    const line = bad.split('\n').findLastIndex((one) => /^ {4}\{$/.test(one)) + 1;
    await seen(page.getByText(new RegExp(`^Ln ${line}, `)));
    const at = Number(/([\d.]+) s/.exec(await first.innerText())?.[1]);
    await press('ArrowRight');
    await reads(page.locator(':focus'), 'Open the recording');
    await press('Enter');
    const bar = page.getByRole('region', { name: 'Looking back' });
    await seen(bar);
    const shown = Number(/shows ([\d.]+) s/.exec(await bar.innerText())?.[1]);
    assert.ok(Math.abs(shown - at) < 0.02, `${shown} s is shown, it failed at ${at} s`);
    await look(studio, 'its recording');
    await press('Escape');
    await gone(bar);
    // The keyboard is still in the list.
    await reads(page.locator(':focus'), 'Open the recording');
    await press('ArrowRight');
    await reads(page.locator(':focus'), 'Run by hand');
    await press('Enter');
    await until('it runs from its beginning', async () => {
      const t = await clock(page);
      return t > 0.2 && t < 4;
    });
    await press('Shift+F5');
  },
);

test(
  'the recording of a plan that ended in an error is opened at that instant',
  project({ 'Hung.test.json': hung }),
  async ({ page, command }) => {
    await command('Run all tests of the project');
    await reads(said(page), '1 of 1 run not as expected.');
    await page.getByRole('button', { name: 'Open the recording' }).click();
    const bar = page.getByRole('region', { name: 'Looking back' });
    await reads(bar, /Everything shows 1\.\d+ s/);
    // The beginning of a plan that has taken no step is the step before.
    await page.getByRole('button', { name: /^To the step of the plan before/ }).click();
    await reads(bar, /Everything shows 0\.000 s/);
  },
);

test(
  'a test that cannot be run says why, at its place, and others are run',
  project({
    'Broken.test.json': broken,
    'Good.test.json': good,
  }),
  async (studio) => {
    const { page, command } = studio;
    await command('Run all tests of the project');
    await reads(said(page), '3 runs as expected.');
    await reads(rows(page).first(), /cannot be run[^]*Broken\.test\.json:3:11/);
    await rows(page).first().getByRole('button').click();
    await seen(page.getByRole('textbox', { name: /Broken\.test\.json/ }));
  },
);

test(
  'a run is stopped in the middle, and a second page sees it',
  project(longTest),
  async (studio, t) => {
    const { page, press, command } = studio;
    await command('Run all tests of the project');
    await reads(said(page), '500 runs started.');
    const other = await openWindow(t, studio.server);
    await other.command('Show Tests');
    await reads(said(other.page), '500 runs started.');
    await until(
      'some are done',
      async () =>
        Number(await page.getByRole('progressbar', { name: 'Runs done' }).getAttribute('value')) >
        0,
    );
    await page.getByRole('button', { name: 'Stop', exact: true }).last().focus();
    await press('Enter');
    await reads(said(page), /^Stopped after \d+ of 500 runs\.$/);
    await reads(said(other.page), /^Stopped after \d+ of 500 runs\.$/);
    await until('none of its processes is left', () =>
      Promise.resolve(processesOf('test-host').length === 0),
    );
  },
);

test(
  'when the server is killed, nothing of a run of tests is left',
  project(longTest),
  async ({ page, command, server }) => {
    await command('Run all tests of the project');
    await reads(said(page), '500 runs started.');
    await until('seeds are run', () => Promise.resolve(processesOf('test-host').length > 1));
    // Nobody looks any more, so that nobody complains.
    await page.goto('about:blank');
    await server.program.stop('SIGKILL');
    await until('none of its processes is left', () =>
      Promise.resolve(processesOf('test-host').length === 0),
    );
  },
);

test(
  'results that a killed server had are told as gone',
  project({ 'Alone.test.json': alone }),
  async (studio) => {
    const { page, command } = studio;
    await command('Run all tests of the project');
    await reads(said(page), '1 run as expected.');
    await restarted(studio);
    await seen(page.getByText(/the results of the tests are gone/));
    studio.complaints.length = 0; // of a server that does not answer
  },
);

test(
  'coverage of plans and scripts is that of the command line',
  project({ 'Alone.test.json': alone, 'Good.test.json': good }),
  async (studio) => {
    const { page, command, layout, place } = studio;
    const byHand = coverageByHand(place);
    await layout('Draw');
    await command('Show Tests');
    await page.getByRole('switch', { name: 'Count script lines' }).click();
    await page.getByRole('button', { name: 'Run all tests' }).click();
    await reads(said(page), '4 runs as expected.');
    const table = page.getByRole('region', { name: 'What the runs went through' });
    for (const { file, kinds } of tableOf(byHand('coverage.txt'))) {
      const text = await table.locator('.tests__file').filter({ hasText: file }).innerText();
      for (const [kind, share] of kinds)
        assert.match(text, new RegExp(`${kind}\\s+${share}`), `${file}: ${kind}`);
    }
    for (const plan of ['Ahead', 'Pause']) {
      await table.getByRole('button', { name: `Show coverage in ${plan}.plan.json` }).click();
      await seen(page.locator('.pcoverage:visible'));
      const counts = countsOf(byHand(`${plan}.svg`));
      const marks = page.locator('.pcanvas:visible [data-covered]');
      await until(`${plan} is marked`, async () => (await marks.count()) > 0);
      for (const mark of await marks.all()) {
        const key = (await mark.getAttribute('data-covered')) ?? '';
        const label = labelOf(key);
        if (label === null) continue; // the drawing of the command line has no supervisors
        assert.equal(Number(await mark.getAttribute('data-count')), counts.get(label), key);
      }
    }
    await look(studio, 'coverage of a plan');
    await page.getByRole('button', { name: 'What was taken, what never was' }).click();
    await seen(page.getByText('Everything was taken.'));
    // Lines of the script of the node that drives, as far as they are in sight.
    await table.getByRole('button', { name: 'Show coverage in carbot.aesl' }).click();
    await seen(page.locator('.cm-coverage .covered'));
    const lines = linesOf(byHand('scripts.info'));
    const shown = await shownLines(page);
    const first = firstLine(place, await page.locator('.cm-line').first().innerText());
    assert.ok(shown.length > 5);
    for (const { line, title } of shown) {
      const often = Number(/Executed (\d+) time/.exec(title)?.[1] ?? 0);
      assert.equal(often, lines.get(line + first - 1), `line ${line}: ${title}`);
    }
    await look(studio, 'coverage of a script');
  },
);

/** Of a table of coverage: files with their kinds. */
function tableOf(/** @type {string} */ text) {
  /** @type {{ file: string, kinds: [string, string][] }[]} */
  const files = [];
  for (const line of text.split('\n\n')[0]?.split('\n') ?? []) {
    const kind = /^ {2}(\w+) +(\d+ of \d+)$/.exec(line);
    if (kind) files.at(-1)?.kinds.push([kind[1] ?? '', kind[2] ?? '']);
    else if (line !== '') files.push({ file: line.replace(/^.*\//, ''), kinds: [] });
  }
  return files;
}

/** Counts of a drawing of `vagus test --coverage`: each label is followed by its count. */
function countsOf(/** @type {string} */ svg) {
  const texts = [...svg.matchAll(/<text[^>]*>([^<]*)<\/text>/g)].map(([, text = '']) => text);
  /** @type {Map<string, number>} */
  const counts = new Map();
  for (let at = 0; at + 1 < texts.length; at += 2)
    counts.set(texts[at] ?? '', (counts.get(texts[at] ?? '') ?? 0) + Number(texts[at + 1]));
  return counts;
}

/** What that drawing calls an element or arrow; all states of these plans have names of their own but "Done". */
function labelOf(/** @type {string} */ key) {
  if (key === 'go' || key === 'rest' || key === 'first' || key === 'second') return key;
  if (key === '@start/late.Timeout') return 'late: Timeout';
  return key === 'go.ForwardSuccessful' ? 'ForwardSuccessful' : null;
}

/** Counts of all lines in a tracefile of lcov. */
function linesOf(/** @type {string} */ info) {
  return new Map(
    [...info.matchAll(/^DA:(\d+),(\d+)$/gm)].map(([, line, count]) => [
      Number(line),
      Number(count),
    ]),
  );
}

/** Lines in sight that were counted, with what is said of them. */
function shownLines(/** @type {Page} */ page) {
  return page.evaluate(() => {
    const top = (/** @type {Element} */ one) => Math.round(one.getBoundingClientRect().top);
    const numbers = new Map(
      [...document.querySelectorAll('.cm-lineNumbers .cm-gutterElement')].map((one) => [
        top(one),
        Number(one.textContent),
      ]),
    );
    return [...document.querySelectorAll('.cm-coverage .covered')].flatMap((one) => {
      const line = numbers.get(top(one.parentElement ?? one)) ?? 0;
      return line > 0 ? [{ line, title: one.getAttribute('title') ?? '' }] : [];
    });
  });
}

/** The line of the file with the first line of a script. */
function firstLine(/** @type {string} */ place, /** @type {string} */ text) {
  const lines = readFileSync(join(place, 'carbot.aesl'), 'utf8').split('\n');
  const at = lines.findIndex((line) => line.endsWith(text) && line.trim() !== '');
  assert.ok(at >= 0, `carbot.aesl has no line ${text}`);
  return at + 1;
}
