// The real server, for one test: on a free port, with its files in a folder of its own that goes with it.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

export const root = new URL('../../../', import.meta.url).pathname;
export const vagusProgram = process.env.VAGUS_BIN ?? join(root, 'build/release/bin/vagus');

/**
 * A test, as far as it is needed here.
 * @typedef {Pick<import('node:test').TestContext, 'after'>} Test
 * @typedef {ReturnType<typeof startProgram>} Program
 * @typedef {Awaited<ReturnType<typeof startServer>>} Server
 */

/** @type {WeakMap<Test, (() => unknown)[]>} */
const endings = new WeakMap();

/**
 * Done at the end of the test, the last one first: programs end before their folders go.
 * @param {Test} test
 * @param {() => unknown} act
 */
export function atEnd(test, act) {
  const known = endings.get(test);
  if (known) return void known.push(act);
  const acts = [act];
  endings.set(test, acts);
  test.after(async () => {
    for (const one of acts.reverse()) await one();
  });
}

/**
 * A folder that is removed at the end of the test.
 * @param {Test} test
 */
export function temporaryFolder(test) {
  const folder = mkdtempSync(join(tmpdir(), 'vagus-e2e-'));
  atEnd(test, () => rmSync(folder, { recursive: true, force: true }));
  return folder;
}

/**
 * Starts a program; it is ended at the end of the test. `pass`: what it gets behind its output.
 * @param {Test} test
 * @param {readonly (string | number)[]} command
 * @param {{ env?: NodeJS.ProcessEnv, pass?: import('node:child_process').StdioPipe[] }} [options]
 */
export function startProgram(test, command, { env = {}, pass = [] } = {}) {
  const [path = '', ...words] = command.map(String);
  const child = spawn(path, words, {
    stdio: ['ignore', 'pipe', 'pipe', ...pass],
    env: { ...process.env, ...env },
  });
  const program = {
    child,
    said: '',
    /** @type {number | NodeJS.Signals | null | undefined} */
    ended: undefined,
    stop,
    line,
    done,
  };
  const ended = new Promise((done) =>
    child.on('exit', (status, signal) => done((program.ended = signal ?? status))),
  );
  /** @type {Set<() => void>} */
  const listeners = new Set();
  for (const stream of [child.stdout, child.stderr])
    stream?.on('data', (words) => {
      program.said += words;
      for (const listener of listeners) listener();
    });
  child.on('error', (error) => (program.said += String(error)));
  atEnd(test, () => stop());
  return program;

  /** @param {NodeJS.Signals} signal */
  async function stop(signal = 'SIGTERM') {
    if (program.ended === undefined) child.kill(signal);
    // One that does not end by itself is killed; the timer is no wait, it is taken back.
    const timer = setTimeout(() => child.kill('SIGKILL'), 5000);
    await ended;
    clearTimeout(timer);
  }

  /** Until it has ended by itself, well. */
  async function done() {
    await ended;
    if (program.ended !== 0)
      throw new Error(`${command[0]} ended with ${program.ended}; it said:\n${program.said}`);
  }

  /**
   * What the pattern finds in what the program prints, now or later.
   * @param {RegExp} pattern
   * @returns {Promise<RegExpExecArray>}
   */
  function line(pattern, within = 60_000) {
    return new Promise((done, fail) => {
      const look = () => {
        const found = pattern.exec(program.said);
        if (!found) return;
        clearTimeout(timer);
        listeners.delete(look);
        done(found);
      };
      const timer = setTimeout(() => {
        listeners.delete(look);
        fail(new Error(`${command[0]} never printed ${pattern}; it said:\n${program.said}`));
      }, within);
      listeners.add(look);
      look();
    });
  }
}

/**
 * `vagus studio`; gives the address that it prints, and the folders that it was given.
 * @param {Test} test
 * @param {readonly string[]} words
 */
export async function startServer(test, words = [], folder = temporaryFolder(test)) {
  const data = join(folder, 'data');
  const program = startProgram(
    test,
    [
      ...[vagusProgram, 'studio', ...words, '--port', 0, '--no-browser'],
      ...['--data', data, '--config', join(folder, 'config')],
    ],
    // Folders that are listed begin there.
    { env: { HOME: folder } },
  );
  const [, address = ''] = await program.line(/^studio (\S+)$/m);
  return { program, address, data, folder };
}

/**
 * The server is killed, and started again at the same address; `meanwhile` is between the two.
 * @param {{ t?: Test, server: Server }} studio
 * @param {() => unknown} meanwhile
 */
export async function restarted({ t, server }, meanwhile = () => {}) {
  const { port } = new URL(server.address);
  await server.program.stop('SIGKILL');
  await meanwhile();
  const words = server.program.child.spawnargs.slice(1);
  const at = words.indexOf('--port');
  const again = startProgram(/** @type {Test} */ (t), [vagusProgram, ...words.with(at + 1, port)]);
  await again.line(/^studio (\S+)$/m);
}
