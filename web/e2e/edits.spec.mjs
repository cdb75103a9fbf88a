// 1,000 random edits of plans, with undo and redo, through the real server: what is taken back is the file
// as it was, byte for byte; what is saved is in the form of `vagus plan format`.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { randomInt } from 'node:crypto';
import { cpSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { runnerImport } from 'vite';
import { atEnd, root, startServer, vagusProgram } from './support/server.mjs';
/** @import { TestContext } from './support/studio.mjs' */

const kEdits = 1000;
const kEditsOfOne = 50;
const kTestMs = 300_000;
const plans = [
  'follow-wall/WallFollow.plan.json',
  'infrared/DriveToBeacon.plan.json',
  'rooms/GoToRoom.plan.json',
  'obstacle/AroundObstacle.plan.json',
];

const core = async (/** @type {string} */ name) =>
  (await runnerImport(new URL(`../core/${name}.ts`, import.meta.url).pathname)).module;

/** A page without a window: commands and their answers, and the first of a topic. */
class Client {
  static async open(/** @type {TestContext} */ t, /** @type {string} */ address) {
    const { origin, hash } = new URL(address);
    const socket = new WebSocket(`${origin.replace('http', 'ws')}/live`, 'vagus-1');
    atEnd(t, () => socket.close());
    await new Promise((done, failed) => {
      socket.onopen = done;
      socket.onerror = failed;
    });
    const client = new Client(socket);
    const token = new URLSearchParams(hash.slice(1)).get('token');
    await client.do('hello', { token, client: 'edits' });
    await client.do('driver.ask', {});
    return client;
  }

  constructor(/** @type {any} */ socket) {
    this.socket = socket;
    this.number = 0;
    this.asked = new Map();
    this.watched = new Map();
    socket.onmessage = (/** @type {MessageEvent} */ { data }) => {
      const told = JSON.parse(data);
      if (told.watch !== undefined) return this.watched.get(told.watch)?.(told.whole);
      const { done, failed } = this.asked.get(told.id) ?? {};
      this.asked.delete(told.id);
      if (told.error) failed?.(new Error(JSON.stringify(told.error)));
      else done?.(told.ok);
    };
  }

  do(/** @type {string} */ name, /** @type {object} */ words) {
    const id = ++this.number;
    return new Promise((done, failed) => {
      this.asked.set(id, { done, failed });
      this.socket.send(JSON.stringify({ id, do: name, in: words }));
    });
  }

  first(/** @type {string} */ topic) {
    return new Promise((done) => {
      this.watched.set(1, (/** @type {any} */ whole) => whole && done(whole));
      void this.do('watch', { watch: 1, topic });
    });
  }
}

void test('what is undone is the file as it was', { timeout: kTestMs }, async (t) => {
  const seed = Number(process.env.VAGUS_SEED ?? randomInt(2 ** 31));
  console.log(`seed ${seed}`);
  const { seeded } = await core('test_seeded');
  const random = seeded(seed);
  const { PlanBoard } = await core('plan/board');
  const { openDocument } = await core('session/open');
  const place = mkdtempSync(join(tmpdir(), 'vagus-edits-'));
  atEnd(t, () => rmSync(place, { recursive: true }));
  cpSync(join(root, 'examples'), place, { recursive: true });

  for (let done = 0; done < kEdits; done += kEditsOfOne) {
    // Scripts of another folder belong to the project: its documents count from the folder of both.
    const doc = plans[(done / kEditsOfOne) % plans.length];
    const [folder] = doc.split('/');
    const { address } = await startServer(t, [join(place, folder)]);
    const client = await Client.open(t, address);
    const { toolboxes } = await client.first('templates');
    const opened = await client.do('doc.open', { doc });
    const link = {
      edit: (/** @type {any} */ order) => client.do('doc.edit', { doc, ...order }),
      pull: (/** @type {any} */ from) => client.do('doc.pull', { doc, ...from }),
    };
    let edits = 0;
    // A step each two seconds: none is one with the one before.
    const made = openDocument(opened, { link, name: () => `e${++edits}`, now: () => edits * 2000 });
    made.session.refused.on((/** @type {string} */ why) =>
      assert.fail(`seed ${seed}: ${JSON.stringify(why)}`),
    );
    const file = made.file();
    const flushed = async () => assert.equal((await made.sync.flushed()).is, 'sent');
    // Ways of arrows are not looked at here: each look at the clock is a second later.
    let seconds = 0;
    const turns = {
      now: () => ++seconds * 1000,
      later: (/** @type {() => unknown} */ act) => void setTimeout(act),
    };
    const board = new PlanBoard(doc, file, toolboxes, turns);
    file.changed.on(() => board.refresh());
    for (let edit = 0; edit < kEditsOfOne; edit++) {
      change(board, toolboxes, random);
      if (random(8) === 0) file.undo();
      if (random(8) === 0) file.redo();
      if (random(4) === 0) await flushed();
    }
    await flushed();
    await client.do('doc.save', { doc });
    const path = join(place, doc);
    const saved = readFileSync(path, 'utf8');
    const formatted = execFileSync(vagusProgram, ['plan', 'format', path], { encoding: 'utf8' });
    assert.equal(saved, formatted, `seed ${seed}`);
    let steps = 0;
    for (; file.canUndo; steps++) {
      file.undo();
      await flushed();
    }
    const { text } = await client.do('doc.open', { doc });
    assert.equal(text, opened.text, `seed ${seed}, after ${done} edits`);
    // What was undone here, not what was undone before it.
    for (; steps > 0; steps--) {
      file.redo();
      await flushed();
    }
    const again = await client.do('doc.open', { doc });
    assert.equal(again.text, saved, `seed ${seed}, after ${done} edits`);
    file.undo();
    await flushed();
    await client.do('doc.revert', { doc });
    cpSync(join(root, 'examples', doc), path);
  }
});

/** One of the edits that hands, forms and commands make. */
function change(
  /** @type {any} */ board,
  /** @type {any} */ toolboxes,
  /** @type {(below: number) => number} */ random,
) {
  const any = (/** @type {any} */ list) => list[random(Math.max(1, list.length))];
  const { actors, variables } = board.model;
  const actor = any(actors)?.name;
  const other = any(actors)?.name;
  const at = { x: random(200) * 8, y: random(200) * 8 };
  const toolbox = any(toolboxes);
  const template = any(toolbox.templates);
  const found = { toolbox: toolbox.name, template };
  if (actor === undefined || template === undefined) return board.addVariable();
  const outcome = any(board.actor(actor).outcomes)?.name;
  switch (random(10)) {
    case 0:
      if (template.kind === 'supervisor') return board.addSupervisor(found, actor);
      return board.addActor(found, at);
    case 1:
      board.selectAll([actor, other]);
      return board.duplicate();
    case 2:
      board.select(actor);
      return board.removeChosen();
    case 3:
      return board.rename(actor, `renamed${random(1e6)}`);
    case 4:
    case 5:
      return outcome === undefined ? board.addVariable() : board.connect(actor, outcome, other);
    case 6:
    case 7:
      board.hold([
        [actor, at],
        [other, { x: at.x + 8, y: at.y }],
      ]);
      return board.letGo();
    case 8:
      return variables.length > 3
        ? board.rename(`$${any(variables).name}`, `value${random(1e6)}`)
        : board.addVariable();
    default:
      return template.kind === 'supervisor'
        ? board.addSupervisor(found, '@start')
        : board.addTarget(found, at, { source: actor, outcome: outcome ?? 'Done' });
  }
}
