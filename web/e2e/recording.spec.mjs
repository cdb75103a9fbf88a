// Recordings as others read and write them: the npm package of MCAP, both ways.
import { McapIndexedReader, McapStreamReader, McapWriter } from '@mcap/core';
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import { zstdDecompressSync } from 'node:zlib';
import { temporaryFolder, vagusProgram } from './support/server.mjs';

const examples = path.resolve(import.meta.dirname, '../../examples');
const decompressHandlers = { zstd: (/** @type {Uint8Array} */ bytes) => zstdDecompressSync(bytes) };

/** So many simulated seconds of the wall follower. */
function recorded(
  /** @type {string} */ folder,
  seconds = 10,
  /** @type {string[]} */ options = [],
) {
  const file = path.join(folder, 'run.mcap');
  const plan = path.join(examples, 'follow-wall/WallFollow.plan.json');
  const world = path.join(examples, 'follow-wall/hall.world.json');
  const words = ['plan', 'run', plan, '--world', world, '--clock', 'virtual'];
  try {
    execFileSync(vagusProgram, [
      ...words,
      '--quiet',
      '--max-time',
      String(seconds),
      '--record',
      file,
      ...options,
    ]);
  } catch (error) {
    // 5: its time was over.
    assert.equal(/** @type {{ status: number }} */ (error).status, 5);
  }
  return file;
}

function readable(/** @type {Uint8Array} */ bytes) {
  return {
    size: () => Promise.resolve(BigInt(bytes.length)),
    read: (/** @type {bigint} */ offset, /** @type {bigint} */ size) =>
      Promise.resolve(bytes.subarray(Number(offset), Number(offset + size))),
  };
}

void test('every channel, schema, attachment, index and the statistics are read', async (t) => {
  const bytes = readFileSync(recorded(temporaryFolder(t)));
  const reader = await McapIndexedReader.Initialize({
    readable: readable(bytes),
    decompressHandlers,
  });
  const topics = [...reader.channelsById.values()].map((channel) => channel.topic).sort();
  const nodes = ['bumper', 'drive', 'head', 'range'].map((node) => `/node/${node}/variables`);
  const common = ['/bus/events', '/bus/frames', '/plan/states', '/plan/trace', '/vagus/check'];
  const others = ['/vagus/input', '/vagus/run', '/world/poses', '/world/scene'];
  assert.deepEqual(topics, [...common, ...nodes, ...others].sort());
  assert.deepEqual([...reader.schemasById.values()].map((schema) => schema.name).slice(0, 1), [
    'foxglove.SceneUpdate',
  ]);
  /** @type {Map<string, { count: number, last: bigint }>} */
  const seen = new Map();
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    const topic = channel?.topic ?? '';
    const before = seen.get(topic) ?? { count: 0, last: 0n };
    assert.ok(message.logTime >= before.last, `${topic} goes back in time`);
    seen.set(topic, { count: before.count + 1, last: message.logTime });
    if (channel?.messageEncoding === 'json') JSON.parse(Buffer.from(message.data).toString());
  }
  for (const [id, count] of reader.statistics?.channelMessageCounts ?? []) {
    assert.equal(BigInt(seen.get(reader.channelsById.get(id)?.topic ?? '')?.count ?? 0), count);
  }
  // A picture at 0 and every 100 ms, a check each second, and one at the end.
  const end = Number(seen.get('/plan/trace')?.last ?? 0n) / 1e9;
  assert.equal(seen.get('/world/poses')?.count, Math.floor(end / 0.1) + 1);
  assert.equal(seen.get('/vagus/check')?.count, Math.floor(end) + 1);
  const names = [];
  for await (const attachment of reader.readAttachments()) names.push(attachment.name);
  for (const name of ['follow-wall/WallFollow.plan.json', 'carbot/carbot.aesl']) {
    assert.ok(names.includes(name), `${name} is not among ${names}`);
  }
  assert.equal(Number(reader.statistics?.attachmentCount), names.length);
});

void test('pictures of a camera are read', async (t) => {
  const reader = await McapIndexedReader.Initialize({
    readable: readable(readFileSync(recorded(temporaryFolder(t), 10, ['--record-camera']))),
    decompressHandlers,
  });
  const channel = [...reader.channelsById.values()].find((one) => one.topic === '/camera/carbot');
  const schema = reader.schemasById.get(channel?.schemaId ?? 0);
  assert.equal(schema?.name, 'foxglove.CompressedImage');
  let last = -1n;
  let end = 0n;
  for await (const message of reader.readMessages({ topics: ['/plan/trace'] })) {
    end = message.logTime;
  }
  for await (const message of reader.readMessages({ topics: ['/camera/carbot'] })) {
    const image = JSON.parse(Buffer.from(message.data).toString());
    assert.deepEqual(Object.keys(image), ['timestamp', 'frame_id', 'data', 'format']);
    assert.equal(image.format, 'png');
    const png = Buffer.from(image.data, 'base64');
    assert.equal(png.subarray(1, 4).toString(), 'PNG');
    // Width and height follow the length and the name of the first chunk.
    assert.deepEqual([png.readUInt32BE(16), png.readUInt32BE(20)], [160, 120]);
    const { sec, nsec } = image.timestamp;
    assert.equal(BigInt(sec) * 1_000_000_000n + BigInt(nsec), message.logTime);
    assert.equal(message.logTime, last < 0n ? 0n : last + 100_000_000n);
    last = message.logTime;
  }
  // The last of the run, which takes a little longer than 10 s to stop the robot.
  assert.ok(end >= 10_000_000_000n && last <= end && end - last < 100_000_000n);
});

void test('a file that was cut off is repaired, and read by others', (t) => {
  const folder = temporaryFolder(t);
  // Chunks of 1 MB, each 26 s of this run: how many there are must not depend on how fast it ran.
  const bytes = readFileSync(recorded(folder, 120));
  const cut = path.join(folder, 'cut.mcap');
  writeFileSync(cut, bytes.subarray(0, Math.floor((bytes.length * 2) / 3)));
  const whole = path.join(folder, 'whole.mcap');
  execFileSync(vagusProgram, ['replay', cut, '--repair', whole]);
  const stream = new McapStreamReader({ decompressHandlers });
  stream.append(readFileSync(whole));
  let messages = 0;
  for (let record = stream.nextRecord(); record; record = stream.nextRecord()) {
    if (record.type === 'Message') messages += 1;
  }
  assert.ok(stream.done());
  assert.ok(messages > 0);
});

void test('what others write is read', async (t) => {
  const folder = temporaryFolder(t);
  /** @type {Uint8Array[]} */
  const parts = [];
  let size = 0n;
  const writer = new McapWriter({
    writable: {
      position: () => size,
      write: (bytes) => {
        parts.push(Uint8Array.from(bytes));
        size += BigInt(bytes.length);
        return Promise.resolve();
      },
    },
  });
  await writer.start({ profile: '', library: 'test' });
  const schemaId = await writer.registerSchema({
    name: 'a',
    encoding: 'jsonschema',
    data: Buffer.from('{}'),
  });
  const channelId = await writer.registerChannel({
    schemaId,
    topic: '/a',
    messageEncoding: 'json',
    metadata: new Map([['k', 'v']]),
  });
  for (let i = 0; i < 100; i += 1) {
    const logTime = BigInt(i);
    const data = Buffer.from(JSON.stringify({ i }));
    await writer.addMessage({ channelId, sequence: i, logTime, publishTime: logTime, data });
  }
  await writer.end();
  const file = path.join(folder, 'theirs.mcap');
  writeFileSync(file, Buffer.concat(parts));
  const ours = path.join(folder, 'ours.mcap');
  const told = execFileSync(vagusProgram, ['replay', file, '--repair', ours]).toString();
  assert.equal(told, `${ours}: 100 messages\n`);
  const bytes = readFileSync(ours);
  const reader = await McapIndexedReader.Initialize({
    readable: readable(bytes),
    decompressHandlers,
  });
  const values = [];
  for await (const message of reader.readMessages()) {
    values.push(JSON.parse(Buffer.from(message.data).toString()).i);
  }
  assert.deepEqual(
    values,
    Array.from({ length: 100 }, (_, i) => i),
  );
  assert.deepEqual([...reader.channelsById.values()][0]?.metadata, new Map([['k', 'v']]));
});
