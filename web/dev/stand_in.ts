// A development tool: stands in for the studio's server. It speaks the protocol over a WebSocket,
// with a made-up robot, so that the pages can be looked at and tested without it. Not shipped.

import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { WebSocketServer, type WebSocket } from 'ws';
import { mergePatch } from '../core/merge_patch';
import type { CommandName, Happening, Json, TopicName } from '../protocol/messages';
import { act, Refused } from './commands';
import { addCrowd, makeModel, openProject, type Model } from './model';
import { documents } from './topics';
import { drive, pictureFrame, posesFrame, raysFrame } from './world';

const policy =
  "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self'; connect-src 'self'; worker-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
const kinds: Record<string, string> = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
  '.woff2': 'font/woff2',
  '.txt': 'text/plain',
  '.png': 'image/png',
};

interface Watch {
  topic: TopicName;
  of: Record<string, Json>;
  sent: Json | undefined;
  /** A page that begins to look sees what is known, also of a robot that stands. */
  flowed?: boolean;
}

interface Page {
  socket: WebSocket;
  number: number;
  watches: Map<number, Watch>;
  done: Map<number, string>;
}

export interface StandIn {
  port: number;
  model: Model;
  refresh(): void;
  sockets(): Set<WebSocket>;
  close(): void;
}

export function startStandIn(options: {
  port: number;
  dist?: string;
  project?: boolean;
  real?: boolean;
  robots?: number;
  crowd?: number;
}): Promise<StandIn> {
  const model = makeModel();
  if (options.project) openProject(model, options.robots);
  addCrowd(model, options.crowd ?? 0);
  const pages = new Set<Page>();
  const known = new Map<string, Map<number, string>>();
  const server = createServer((request, response) =>
    serveFile(options.dist ?? 'dist', request.url ?? '/', response),
  );
  const sockets = new WebSocketServer({
    server,
    path: '/live',
    handleProtocols: () => 'vagus-1',
  });
  let clients = 0;
  sockets.on('connection', (socket) => {
    const page: Page = { socket, number: ++clients, watches: new Map(), done: new Map() };
    pages.add(page);
    socket.on('close', () => pages.delete(page));
    socket.on('message', (data) =>
      receive(model, page, JSON.parse(String(data)) as Message, known, refresh),
    );
  });
  const refresh = () =>
    pages.forEach((page) =>
      page.watches.forEach((watch, number) => sendDocument(model, page, number, watch)),
    );
  const timer =
    options.real === false ? undefined : setInterval(() => tick(model, pages, refresh), 50);
  return listen(server, options.port).then((port) => ({
    port,
    model,
    refresh,
    sockets: () => sockets.clients,
    close() {
      clearInterval(timer);
      sockets.clients.forEach((socket) => socket.terminate());
      server.close();
    },
  }));
}

interface Message {
  id: number;
  do: CommandName;
  in: Record<string, Json>;
}

function receive(
  model: Model,
  page: Page,
  message: Message,
  known: Map<string, Map<number, string>>,
  refresh: () => void,
): void {
  const answer = (body: object) => {
    const text = JSON.stringify({ id: message.id, ...body });
    page.done.set(message.id, text);
    page.socket.send(text);
  };
  const before = page.done.get(message.id);
  if (before) return page.socket.send(before);
  switch (message.do) {
    case 'hello': {
      const client = String(message.in['client']);
      page.done = known.get(client) ?? page.done;
      known.set(client, page.done);
      return answer({
        ok: {
          version: 'stand-in',
          role: 'drive',
          number: page.number,
          driver: true,
          wall: Date.now(),
        },
      });
    }
    case 'watch': {
      const watch: Watch = {
        topic: message.in['topic'] as TopicName,
        of: (message.in['of'] ?? {}) as Record<string, Json>,
        sent: undefined,
      };
      page.watches.set(Number(message.in['watch']), watch);
      answer({ ok: {} });
      return sendDocument(model, page, Number(message.in['watch']), watch);
    }
    case 'unwatch':
      page.watches.delete(Number(message.in['watch']));
      return answer({ ok: {} });
    default:
      try {
        answer({ ok: act(model, message.do, message.in, page.number) });
      } catch (error) {
        answer({
          error: error instanceof Refused ? error.problem : { code: 'failed', what: String(error) },
        });
      }
      refresh();
  }
}

function sendDocument(model: Model, page: Page, number: number, watch: Watch): void {
  const make = documents[watch.topic];
  if (!make) return;
  const value = JSON.parse(JSON.stringify(make(model, watch.of))) as Json;
  if (watch.sent === undefined) page.socket.send(JSON.stringify({ watch: number, whole: value }));
  else {
    const patch = difference(watch.sent, value);
    if (patch === undefined) return;
    page.socket.send(JSON.stringify({ watch: number, patch }));
    if (JSON.stringify(mergePatch(watch.sent, patch)) !== JSON.stringify(value))
      watch.sent = undefined;
  }
  watch.sent = value;
}

function difference(before: Json, after: Json): Json | undefined {
  if (JSON.stringify(before) === JSON.stringify(after)) return undefined;
  if (!isTable(before) || !isTable(after)) return after;
  const patch: Record<string, Json> = {};
  for (const key of Object.keys(before)) if (!(key in after)) patch[key] = null;
  for (const [key, value] of Object.entries(after)) {
    const inner = key in before ? difference(before[key] ?? null, value) : value;
    if (inner !== undefined) patch[key] = inner;
  }
  return patch;
}

function tick(model: Model, pages: Set<Page>, refresh: () => void): void {
  if (model.clock.state === 'running')
    model.clock = {
      ...model.clock,
      t: Math.round((model.clock.t + 0.05 * model.clock.speed) * 1000) / 1000,
      wall: Date.now(),
    };
  const passed = model.clock.state === 'running' ? 0.05 * (model.clock.speed || 20) : 0;
  if (model.world && passed > 0) drive(model.world, passed);
  refresh();
  for (const page of pages)
    for (const [number, watch] of page.watches) flow(model, page, number, watch);
}

function flow(model: Model, page: Page, number: number, watch: Watch): void {
  const { world } = model;
  if (world && model.clock.state !== 'none') {
    const { t } = model.clock;
    if (watch.topic === 'poses') page.socket.send(posesFrame(world, number, t));
    if (watch.topic === 'rays') page.socket.send(raysFrame(world, number, t));
    if (watch.topic === 'picture') page.socket.send(pictureFrame(number, t));
  }
  const { t, state } = model.clock;
  if (state === 'none' || (state !== 'running' && watch.flowed)) return;
  watch.flowed = true;
  switch (watch.topic) {
    case 'happenings':
      if (state === 'running')
        page.socket.send(JSON.stringify({ watch: number, items: happeningsAt(t), left_out: 0 }));
      return;
    case 'variables':
      return page.socket.send(variablesFrame(model, number, watch.of, t));
    case 'samples':
      return page.socket.send(samplesFrame(number, watch.of, t));
    default:
  }
}

function happeningsAt(t: number): Happening[] {
  const instant = Math.round(t * 20);
  const turns: [string, number, string, number[]][] = [
    ['main', 0, 'drive.steer', [20417, wave(0, t), -96]],
    ['range', 3, 'range.measured', [20417, -650 + (instant % 90) * 15, wave(2, t)]],
    ['main', 0, 'drive.alive', [20417]],
  ];
  const [source, node, name, args] = turns[instant % 3] ?? ['main', 0, '', []];
  const made = { number: instant * 2, t, wall: Date.now(), node, source, name, args, text: '' };
  const events: Happening[] = [{ ...made, kind: 'event' }];
  if (instant % 100 === 50)
    events.push({
      ...made,
      number: instant * 2 + 1,
      kind: 'loaded',
      node: 1,
      source: 'drive',
      name: 'drive',
      args: [],
      text: 'script of this project',
    });
  return events;
}

function wave(word: number, t: number): number {
  return Math.round(Math.sin(t / (1 + (word % 5)) + word) * (200 + word * 7));
}

function frameOf(kind: number, number: number, t: number, payload: Buffer): Buffer {
  const head = Buffer.alloc(16);
  head.writeUInt8(kind, 0);
  head.writeUInt32LE(number, 4);
  head.writeDoubleLE(t, 8);
  return Buffer.concat([head, payload]);
}

/** The ranges that are asked, every word; a word of four stands still. */
function variablesFrame(model: Model, number: number, of: Record<string, Json>, t: number): Buffer {
  const node = Number(of['node']);
  const records = (of['ranges'] as [number, number][]).map(([address, count]) => {
    const record = Buffer.alloc(4 + count * 2);
    record.writeUInt16LE(address, 0);
    record.writeUInt16LE(count, 2);
    for (let index = 0; index < count; index++)
      record.writeInt16LE(wordOf(model, node, address + index, t), 4 + index * 2);
    return record;
  });
  return frameOf(1, number, t, Buffer.concat(records));
}

function wordOf(model: Model, node: number, address: number, t: number): number {
  const key = `${node} ${address}`;
  const set = model.written.get(key);
  if (set !== undefined) return set;
  return address % 4 === 3 ? address * 10 : wave(address + node, t);
}

function samplesFrame(number: number, of: Record<string, Json>, t: number): Buffer {
  const words = of['words'] as [number, number][];
  const payload = Buffer.alloc(words.length * 12);
  words.forEach(([node, address], index) => {
    payload.writeDoubleLE(t, index * 12);
    payload.writeUInt16LE(index, index * 12 + 8);
    payload.writeInt16LE(wave(address + node, t), index * 12 + 10);
  });
  return frameOf(2, number, t, payload);
}

function serveFile(dist: string, url: string, response: import('node:http').ServerResponse): void {
  const path = normalize(decodeURIComponent(url.split('?')[0] ?? '/')).replace(
    /\/$/,
    '/index.html',
  );
  const file = join(dist, path);
  response.setHeader('Content-Security-Policy', policy);
  response.setHeader('X-Content-Type-Options', 'nosniff');
  if (!file.startsWith(dist) || !existsSync(file) || !statSync(file).isFile())
    return void response.writeHead(404).end('Not found.');
  response.setHeader('Content-Type', kinds[extname(file)] ?? 'application/octet-stream');
  createReadStream(file).pipe(response);
}

function listen(server: Server, port: number): Promise<number> {
  return new Promise((resolve) =>
    server.listen(port, '127.0.0.1', () => {
      const address = server.address();
      resolve(typeof address === 'object' && address ? address.port : port);
    }),
  );
}

function isTable(value: Json): value is Record<string, Json> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
