// Fleets for tests: a broker (Debian's mosquitto), robots that are served, and many that only tell.
import { writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { aesl, freePort, listening, makeProject } from './robots.mjs';
import { startProgram, temporaryFolder, vagusProgram } from './server.mjs';

/** @import { Test } from './server.mjs' */

export const kFleet = 'lab';
const kMosquitto = process.env.MOSQUITTO ?? '/usr/sbin/mosquitto';

/**
 * A broker on loopback that everybody may use; start() again after its program was stopped.
 * @param {Test} t
 */
export async function startBroker(t) {
  const port = await freePort();
  const file = join(temporaryFolder(t), 'mosquitto.conf');
  writeFileSync(
    file,
    `listener ${port} 127.0.0.1\nallow_anonymous true\npersistence false\nmax_queued_messages 30000\n`,
  );
  const start = async () => {
    const program = startProgram(t, [kMosquitto, '-c', file]);
    await listening(port);
    return program;
  };
  return { target: `mqtt://127.0.0.1:${port}/${kFleet}`, start, program: await start() };
}

/**
 * Robots r1 to rN of one program; those up to `changing` do something else five times a second.
 * @param {Test} t
 * @param {string} target
 * @param {number} robots
 */
export async function startCrowd(t, target, robots, changing = 0) {
  const crowd = join(dirname(vagusProgram), 'fleet_crowd');
  const program = startProgram(t, [crowd, target, robots, changing]);
  await program.line(/^crowd \d+$/m);
  return program;
}

/**
 * A broker with rights, as `vagus fleet init` and `serve` make it; login(): words of the command line.
 * @param {Test} t
 * @param {readonly string[]} robots
 */
export async function startOwnBroker(t, robots) {
  const folder = join(temporaryFolder(t), 'broker');
  const [port, webPort] = [await freePort(), await freePort()];
  const named = robots.flatMap((robot) => ['--robot', robot]);
  const ports = ['--port', port, '--web-port', webPort];
  const made = startProgram(t, [vagusProgram, 'fleet', 'init', folder, ...ports, ...named]);
  await made.done();
  const program = startProgram(t, [vagusProgram, 'fleet', 'serve', folder]);
  await program.line(/^fleet mqtts/m);
  const ca = join(folder, 'ca.crt');
  const file = (/** @type {string} */ name) => join(folder, `${name}.login`);
  return {
    target: `mqtts://localhost:${port}/${kFleet}`,
    program,
    ca,
    file,
    login: (/** @type {string} */ name) => ['--tls-ca', ca, '--login', file(name)],
  };
}

const kScript = `var go = 0
var heard = 0

timer.period[0] = 20

onevent timer0
	if go == 1 then
		go = 0
		emit alarm [7]
	end

onevent alarm
	heard += 1
`;

const kRoom = {
  format: 'vagus-world/1',
  name: 'Room',
  size: [2, 2],
  robots: [{ name: 'thymio', type: 'thymio2', at: [1, 1], script: 'robot.aesl' }],
};

/**
 * The project of a member; `more` is of its key "fleet", `script` comes before its own.
 * @param {Test} t
 * @param {{ script?: string, more?: object }} options
 */
export function makeAlarm(t, { script = '', more = {} } = {}) {
  const fleet = { name: kFleet, groups: ['red'], send: ['alarm'], hear: ['alarm'], ...more };
  const project = {
    name: 'Alarm',
    scripts: ['robot.aesl'],
    world: 'room.world.json',
    target: 'sim',
  };
  return makeProject(
    t,
    { ...project, fleet },
    {
      'robot.aesl': aesl({ 'thymio-II': script + kScript }, { events: { alarm: 1 } }),
      'room.world.json': JSON.stringify(kRoom),
    },
  );
}

/**
 * A simulated Thymio that is served as a member of the fleet.
 * @param {Test} t
 * @param {string} target
 * @param {string} name
 * @param {readonly string[]} login
 */
export async function startMember(t, target, name, login = []) {
  const { folder, place } = makeAlarm(t);
  const program = startProgram(t, [
    ...[vagusProgram, 'serve', place, '--start', '--port', 0],
    ...['--data', join(folder, 'data'), '--config', join(folder, 'config')],
    ...['--fleet', target, '--robot', name, ...login],
  ]);
  const [, address = ''] = await program.line(/^serve (\S+)/m);
  await program.line(/fleet: this robot is/);
  return { program, address };
}
