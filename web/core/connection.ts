// One connection to the server that outlives its sockets: it says hello, comes back by itself, asks
// again for what was not answered, and renews its subscriptions. A caller sees a promise for each
// command and never a socket. What can move a robot (kind act) has a deadline in the server's time
// and is never asked again: minutes later nobody expects it.

import { misfit, misfitItem } from '../protocol/check';
import {
  commandTable,
  limits,
  topicTable,
  type CommandName,
  type Commands,
  type Json,
  type Problem,
  type TopicName,
  type Topics,
} from '../protocol/messages';
import { Emitter } from './emitter';
import { mergePatch } from './merge_patch';
import type { Socket, World } from './socket';

export const kFirstRetryMs = 250;
export const kRetryMsMax = 5000;
/** As many commands may wait for an answer; the next one is refused at once. */
export const kWaitingMax = 2000;

/** The server pings every second; three pings that are missing are silence. */
export const kSilentMs = 3500;

const kTimesKept = 8;

/** What a person waits for: it ends with the connection, and is not sent again behind their back. */
const kSaves: ReadonlySet<CommandName> = new Set(['doc.save', 'doc.save_all']);

export type Link =
  | { state: 'connecting' }
  | {
      state: 'open';
      number: number;
      role: 'drive' | 'look';
      version: string;
      /** The connection is open, but the server has said nothing for kSilentMs. */
      silentSince?: number;
    }
  | { state: 'lost'; since: number }
  | { state: 'refused'; problem: Problem };

/** Somebody is there to do at once what is asked. */
export function answers(link: Link): boolean {
  return link.state === 'open' && link.silentSince === undefined;
}

export class CommandError extends Error {
  constructor(readonly problem: Problem) {
    super(problem.what);
  }
}

export interface WatchEvents {
  /** A document, whole or after a change. */
  value?(value: Json): void;
  items?(items: Json[], leftOut: number): void;
  frame?(time: number, payload: DataView): void;
  failed?(problem: Problem): void;
}

interface Waiting {
  text: string;
  command: CommandName;
  done(out: Json): void;
  failed(problem: Problem): void;
}

interface Watch {
  topic: TopicName;
  of: Json | undefined;
  rate: number | undefined;
  events: WatchEvents;
  value: Json | undefined;
}

export interface ConnectionOptions {
  token: string;
  client: string;
  /** Of this page load. */
  nonce?: string | undefined;
  /** The server has given this page another name: another one has its own. */
  renamed?: ((client: string) => void) | undefined;
  name?: string | undefined;
  /** This page had control when it was last heard of it. */
  hadControl?: (() => boolean) | undefined;
  /** The first number of a command; higher than all that this client has used before. */
  firstId?: number | undefined;
  /** Told before a number is used, so that a reload goes on behind it. */
  usedId?: ((id: number) => void) | undefined;
  now(): number;
  /** Milliseconds that never jump; `now` if it is missing. */
  clock?: (() => number) | undefined;
}

export class Connection {
  readonly changed = new Emitter<Link>();
  /** Another life of the server: what it counted begins again. Before anything else is heard of it. */
  readonly renewed = new Emitter<void>();
  /** Somebody else has pressed Stop. */
  readonly stopped = new Emitter<void>();
  readonly odd = new Emitter<string>();
  link: Link = { state: 'connecting' };

  private socket: Socket | null = null;
  private nextId: number;
  private nextWatch = 1;
  private helloId = 0;
  private retries = 0;
  private readonly waiting = new Map<number, Waiting>();
  private readonly watches = new Map<number, Watch>();
  private cancelRetry: (() => void) | null = null;
  private cancelSilence: () => void = ignore;
  private closed = false;
  private client: string;
  private epoch: string | null = null;
  /** For requests beside the socket, too. */
  token: string;
  /** By how much the server's clock was ahead of ours, as the last messages that told it say. */
  private ahead: number[] = [];
  /** How often others have pressed Stop, as far as this page has heard: what it asks for counts on that. */
  private stops: number | undefined;

  constructor(
    private readonly world: World,
    private readonly options: ConnectionOptions,
  ) {
    this.nextId = options.firstId ?? 1;
    this.client = options.client;
    this.token = options.token;
  }

  /** A word for the life of the server that was heard last. */
  get life(): string {
    return this.epoch ?? '';
  }

  start(): void {
    this.cancelRetry = null;
    if (this.closed || this.socket) return;
    const own: Socket = this.world.connect({
      open: () => this.sayHello(),
      text: (message) => this.socket === own && this.received(message),
      bytes: (message) => this.socket === own && this.receivedFrame(message),
      closed: () => this.socket === own && this.lost(),
    });
    this.socket = own;
  }

  stop(): void {
    this.closed = true;
    this.cancelRetry?.();
    this.cancelSilence();
    const socket = this.socket;
    this.socket = null;
    socket?.close();
  }

  /** `due`: the deadline() of the key press, if something was waited for since. */
  send<C extends CommandName>(
    command: C,
    input: Commands[C]['in'],
    due?: number,
  ): Promise<Commands[C]['out']> {
    const id = this.takeId();
    const act = commandTable[command].kind === 'act';
    const until = act ? (due ?? this.deadline()) : undefined;
    const stops = act ? this.stops : undefined;
    const text = JSON.stringify({ id, do: command, in: input, until, stops });
    return new Promise((resolve, reject) => {
      const failed = (problem: Problem) => reject(new CommandError(problem));
      if ((act || kSaves.has(command)) && !answers(this.link))
        return failed(this.link.state === 'refused' ? this.link.problem : notSent);
      // The server would end the connection, and again with each one on which it is sent again.
      if (isTooLong(text)) return failed(tooLong(command));
      if (this.waiting.size >= kWaitingMax) return failed(tooMany);
      // The check at the border has proved the shape.
      const done = (out: Json) => resolve(out as Commands[C]['out']);
      this.waiting.set(id, { text, command, done, failed });
      if (this.link.state === 'open') this.socket?.send(text);
      else if (this.link.state === 'refused') this.fail(id, this.link.problem);
    });
  }

  /** Subscribes until the returned function is called; renewed by itself after a lost connection. */
  watch<T extends TopicName>(
    topic: T,
    of: Topics[T]['of'],
    events: WatchEvents,
    rate?: number,
  ): () => void {
    const number = this.nextWatch++;
    const watch: Watch = {
      topic,
      of: Object.keys(of).length ? of : undefined,
      rate,
      events,
      value: undefined,
    };
    this.watches.set(number, watch);
    if (this.link.state === 'open') this.sendWatch(number, watch);
    return () => {
      if (this.watches.delete(number) && this.link.state === 'open')
        void this.send('unwatch', { watch: number }).catch(ignore);
    };
  }

  /** Until when the server may do what is asked for now, in its time; it has not told it yet: undefined. */
  deadline(): number | undefined {
    // What lay unread for a while makes the server's clock seem slow, never fast.
    return this.ahead.length ? Math.max(...this.ahead) + this.clock() + limits.act_ms : undefined;
  }

  /** The wall clock of the server, whose computer may be another one. */
  wall(): number {
    return this.options.now() + this.wallAhead;
  }
  private wallAhead = 0;

  private clock(): number {
    return (this.options.clock ?? this.options.now)();
  }

  private tellTime(server: number): void {
    this.ahead = [...this.ahead, server - this.clock()].slice(-kTimesKept);
  }

  private takeId(): number {
    const id = this.nextId++;
    this.options.usedId?.(id);
    return id;
  }

  private sayHello(): void {
    this.helloId = this.takeId();
    const { name, nonce, hadControl } = this.options;
    const control = hadControl?.() === true ? { had_control: true } : {};
    const input = { token: this.token, client: this.client, name, nonce, ...control };
    this.socket?.send(JSON.stringify({ id: this.helloId, do: 'hello', in: input }));
  }

  private welcomed(out: Json): void {
    const wrong = misfit(out, commandTable.hello.out);
    if (wrong)
      return this.refused({
        code: 'bad_message',
        what: `The server's greeting is not understood (${wrong}).`,
      });
    const hello = out as unknown as Commands['hello']['out'];
    this.retries = 0;
    this.ahead = [];
    this.tellTime(hello.now);
    this.stops = hello.stops;
    this.wallAhead = hello.wall - this.options.now();
    if (hello.client !== this.client) this.options.renamed?.(hello.client);
    this.client = hello.client;
    const isOther = this.epoch !== null && this.epoch !== hello.epoch;
    this.epoch = hello.epoch;
    if (isOther) this.renewed.emit();
    this.setLink({ state: 'open', number: hello.number, role: hello.role, version: hello.version });
    this.listenForPings();
    // Unanswered commands first, in their order: what is subscribed to shows their effect at once.
    for (const [, waiting] of this.waiting) this.socket?.send(waiting.text);
    for (const [number, watch] of this.watches) this.sendWatch(number, watch);
  }

  private refused(problem: Problem): void {
    this.setLink({ state: 'refused', problem });
    for (const id of [...this.waiting.keys()]) this.fail(id, problem);
    this.stop();
  }

  private sendWatch(number: number, watch: Watch): void {
    // A watch is not repeated as a command: it is renewed as a whole with each new connection.
    const id = this.takeId();
    this.watchIds.set(id, number);
    const input = { watch: number, topic: watch.topic, of: watch.of, rate: watch.rate };
    this.socket?.send(JSON.stringify({ id, do: 'watch', in: input }));
  }
  private readonly watchIds = new Map<number, number>();

  private received(message: string): void {
    const parsed = parse(message);
    if (parsed === null) return this.odd.emit('a message that is not JSON');
    if ('ping' in parsed) return this.answerPing(parsed);
    if ('watch' in parsed) return this.receivedChange(parsed);
    const id = Number(parsed['id']);
    const problem = parsed['error'] as unknown as Problem | undefined;
    if (id === this.helloId)
      return problem ? this.refused(problem) : this.welcomed(parsed['ok'] ?? null);
    const watch = this.watchIds.get(id);
    if (watch !== undefined) {
      this.watchIds.delete(id);
      if (problem) this.watches.get(watch)?.events.failed?.(problem);
    } else if (problem) this.fail(id, problem);
    else this.succeed(id, parsed['ok'] ?? {});
  }

  private answerPing(ping: Record<string, Json>): void {
    this.tellTime(Number(ping['now']));
    this.socket?.send(JSON.stringify({ pong: ping['ping'] }));
    this.hearStops(ping['stops']);
    if (this.link.state !== 'open') return;
    if (!answers(this.link)) {
      const { number, role, version } = this.link;
      this.setLink({ state: 'open', number, role, version });
    }
    this.listenForPings();
  }

  private hearStops(stops: Json | undefined): void {
    if (typeof stops !== 'number' || stops === this.stops) return;
    this.stops = stops;
    this.stopped.emit();
  }

  private listenForPings(): void {
    this.cancelSilence();
    this.cancelSilence = this.world.later(kSilentMs, () => {
      if (this.link.state !== 'open') return;
      this.setLink({ ...this.link, silentSince: this.options.now() });
      this.failAll((command) => kSaves.has(command));
    });
  }

  private succeed(id: number, out: Json): void {
    const waiting = this.waiting.get(id);
    if (!waiting) return;
    this.waiting.delete(id);
    const wrong = misfit(out, commandTable[waiting.command].out);
    if (!wrong) return waiting.done(out);
    waiting.failed({
      code: 'bad_message',
      what: `The answer to ${waiting.command} is not understood (${wrong}).`,
    });
  }

  private fail(id: number, problem: Problem): void {
    const waiting = this.waiting.get(id);
    this.waiting.delete(id);
    waiting?.failed(problem);
  }

  /** Nobody knows whether these were done. */
  private failAll(is: (command: CommandName) => boolean): void {
    for (const [id, { command }] of [...this.waiting])
      if (is(command)) this.fail(id, kSaves.has(command) ? unsaved : unknown);
  }

  private receivedChange(message: Record<string, Json>): void {
    const watch = this.watches.get(Number(message['watch']));
    if (!watch) return;
    const about = topicTable[watch.topic];
    if ('items' in message) {
      const items = Array.isArray(message['items']) ? message['items'] : [];
      const good = items.filter((item) => about.item && misfitItem(item, about.item) === null);
      if (good.length < items.length) this.odd.emit(`an item of ${watch.topic}`);
      return watch.events.items?.(good, Number(message['left_out'] ?? 0));
    }
    const patch = message['patch'];
    if (patch !== undefined && watch.value === undefined) return;
    const value = patch === undefined ? (message['whole'] ?? null) : mergePatch(watch.value, patch);
    const touched = isTable(patch) ? new Set(Object.keys(patch)) : undefined;
    const wrong = misfit(value, about.is ?? {}, touched);
    if (wrong) return this.odd.emit(`${watch.topic}: ${wrong}`);
    watch.value = value;
    watch.events.value?.(value);
  }

  private receivedFrame(message: ArrayBuffer): void {
    if (message.byteLength < 16) return this.odd.emit('a frame that is too short');
    const view = new DataView(message);
    const watch = this.watches.get(view.getUint32(4, true));
    if (!watch || topicTable[watch.topic].number !== view.getUint8(0)) return;
    watch.events.frame?.(view.getFloat64(8, true), new DataView(message, 16));
  }

  private lost(): void {
    this.socket = null;
    this.cancelSilence();
    this.watchIds.clear();
    this.failAll((command) => commandTable[command].kind === 'act' || kSaves.has(command));
    if (this.closed) return;
    if (this.link.state !== 'lost') this.setLink({ state: 'lost', since: this.options.now() });
    const wait = Math.min(kRetryMsMax, kFirstRetryMs * 2 ** this.retries++);
    // Spread, so that many pages do not come back at one moment.
    this.cancelRetry = this.world.later(wait * (0.75 + 0.5 * this.world.chance()), () =>
      this.start(),
    );
  }

  private setLink(link: Link): void {
    this.link = link;
    this.changed.emit(link);
  }
}

const tooMany: Problem = {
  code: 'limit',
  what: 'Too many commands wait for the server. Wait until it answers.',
};

const notSent: Problem = {
  code: 'unavailable',
  what: 'The server is not connected; nothing was sent. Do it again when it is.',
};
const unknown: Problem = {
  code: 'unavailable',
  what: 'The connection was lost before the answer came. It may have been done; it is not sent again.',
};

const unsaved: Problem = {
  code: 'unavailable',
  what: 'The connection was lost before the answer came. It may not be saved: save again when the server is back.',
};

function tooLong(command: CommandName): Problem {
  const most = Math.floor(limits.message_bytes / 2 ** 20);
  const what = `This is more than ${most} MiB, which is the most that the server takes at once (${command}). Nothing was sent: undo it, or paste less.`;
  return { code: 'limit', what };
}

function isTooLong(text: string): boolean {
  // A character is three bytes at most for each of its units.
  if (text.length * 3 <= limits.message_bytes) return false;
  return new TextEncoder().encode(text).length > limits.message_bytes;
}

function ignore(): void {}

function parse(message: string): Record<string, Json> | null {
  try {
    const value: Json = JSON.parse(message) as Json;
    return isTable(value) ? value : null;
  } catch {
    return null;
  }
}

function isTable(value: Json | undefined): value is { [key: string]: Json } {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
