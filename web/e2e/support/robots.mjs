// Robots for tests: nodes on a bus of this computer, and projects for them.
import { mkdirSync, writeFileSync } from 'node:fs';
import { connect, createServer } from 'node:net';
import { join } from 'node:path';
import { until } from './until.mjs';
import { startProgram, temporaryFolder, vagusProgram } from './server.mjs';

const kListening = /^listening tcp:127\.0\.0\.1:(\d+)$/m;

/** @typedef {import('./server.mjs').Test} Test */

/**
 * A port that nobody listens on now.
 * @returns {Promise<number>}
 */
export function freePort() {
  return new Promise((done, fail) => {
    const probe = createServer();
    probe.on('error', fail);
    probe.listen(0, '127.0.0.1', () => {
      const { port } = /** @type {import('node:net').AddressInfo} */ (probe.address());
      probe.close(() => done(port));
    });
  });
}

/**
 * Until somebody listens there, who has then seen a client come and go: asebaplayground dies of one too early.
 * @param {number} port
 */
export function listening(port) {
  return until(
    `somebody listens on port ${port}`,
    () =>
      new Promise((done, fail) => {
        const client = connect(port, '127.0.0.1');
        client.on('connect', () => client.end());
        client.on('data', () => {});
        client.on('close', () => done(true));
        client.on('error', fail);
      }),
  );
}

/**
 * `vagus switch` before these ports; gives its own.
 * @param {Test} t
 * @param {...number} ports
 */
export async function startSwitch(t, ...ports) {
  const targets = ports.map((port) => `tcp:127.0.0.1:${port}`);
  const program = startProgram(t, [
    vagusProgram,
    'switch',
    '--listen',
    'tcp:127.0.0.1:0',
    ...targets,
  ]);
  return Number((await program.line(kListening))[1]);
}

/**
 * `vagus node`; ended by its stop().
 * @param {Test} t
 * @param {string} name
 * @param {number} id
 * @param {readonly (string | number)[]} words
 */
export async function startNode(t, name, id, port = 0, words = []) {
  const listen = `tcp:127.0.0.1:${port}`;
  const program = startProgram(t, [
    vagusProgram,
    'node',
    ...['--id', id, '--name', name, '--listen', listen, ...words],
  ]);
  return { program, port: Number((await program.line(kListening))[1]) };
}

/**
 * A folder with these files, as a project.
 * @param {Test} t
 * @param {object} project
 * @param {Record<string, string>} files
 */
export function makeProject(t, project, files) {
  const folder = temporaryFolder(t);
  const place = join(folder, 'project');
  mkdirSync(place);
  const about = { format: 'vagus-project/1', ...project };
  writeFileSync(join(place, 'vagus.json'), JSON.stringify(about, null, 2));
  for (const [name, text] of Object.entries(files)) writeFileSync(join(place, name), text);
  return { folder, place, words: [place] };
}

/**
 * An .aesl file: scripts by the names of their nodes, which are numbered from 1.
 * @typedef {{ events?: Record<string, number>, constants?: Record<string, number> }} Shared
 * @param {Record<string, string>} scripts
 * @param {Shared} shared
 */
export function aesl(scripts, { events = {}, constants = {} } = {}) {
  /**
   * @param {string} kind
   * @param {string} attribute
   * @param {Record<string, number>} from
   */
  const list = (kind, attribute, from) =>
    Object.entries(from).map(
      ([name, value]) => `<${kind} ${attribute}="${value}" name="${name}"/>`,
    );
  return [
    '<!DOCTYPE aesl-source>',
    '<network>',
    ...list('event', 'size', events),
    ...list('constant', 'value', constants),
    ...Object.entries(scripts).map(
      ([name, text], index) =>
        `<node nodeId="${index + 1}" name="${name}"><![CDATA[${text}]]></node>`,
    ),
    '</network>',
    '',
  ].join('\n');
}

/**
 * Two nodes, left and right, behind a switch, and a project for them that connects to it.
 * @param {Test} t
 * @param {Record<string, string>} scripts
 * @param {Shared} [shared]
 */
export async function twoNodes(t, scripts, shared) {
  const left = await startNode(t, 'left', 1);
  const right = await startNode(t, 'right', 2);
  const port = await startSwitch(t, left.port, right.port);
  const made = makeProject(
    t,
    { name: 'Two', scripts: ['two.aesl'], target: `tcp:127.0.0.1:${port}` },
    { 'two.aesl': aesl(scripts, shared) },
  );
  return { ...made, left, right, port };
}
