// A server of several files and a page's link to it, in this process: sockets that carry messages in their
// order, late, and lose them when they are cut; the clock is the test's.

import { Connection } from './connection';
import { Documents } from './documents';
import { ModelServer, type Schedule } from './session/test_server';
import type { SocketEvents, World } from './socket';
import { TopicCache } from './topics';

const kPingMs = 1000;

interface Message {
  id: number;
  do: string;
  in: Record<string, unknown>;
  pong?: number;
}

interface HouseFile {
  text: ModelServer;
  gone: boolean;
}

/** Files by their names, with those that they had before. */
export class House {
  readonly files = new Map<string, HouseFile>();
  readonly lines: Line[] = [];
  private readonly moved = new Map<string, string>();

  add(name: string, text: string): void {
    const made = { text: new ModelServer(text), gone: false };
    made.text.told.push(() => this.tell());
    this.files.set(name, made);
  }

  rename(from: string, to: string): void {
    const file = this.files.get(from);
    if (!file || this.files.has(to)) return;
    this.files.delete(from);
    this.files.set(to, file);
    this.moved.delete(to);
    this.moved.set(from, to);
    this.tell();
  }

  /** The text stays: not on disk, or saved again. */
  setGone(name: string, gone: boolean): void {
    const file = this.files.get(name);
    if (file) file.gone = gone;
    this.tell();
  }

  restart({ loses }: { loses: boolean }): void {
    this.lines.forEach((line) => line.cut());
    for (const { text } of this.files.values()) text.restart({ loses });
  }

  get texts(): ModelServer[] {
    return [...this.files.values()].map(({ text }) => text);
  }

  nameNow(name: string): string {
    const to = this.files.has(name) ? undefined : this.moved.get(name);
    return to === undefined ? name : this.nameNow(to);
  }

  documentOf(name: string): unknown {
    const now = this.nameNow(name);
    const { text, gone } = this.at(now);
    const more = { language: 'text', ends: 'lf', unsaved: false, by: '', disk: false };
    return { ...text.state, ...more, gone, ...(now === name ? {} : { moved: now }) };
  }

  answer(client: number, { id, do: command, in: input }: Message): unknown {
    const { text } = this.at(this.nameNow(input['doc'] as string));
    if (command === 'doc.edit') return text.edit(`${client} ${id}`, input as never);
    if (command === 'doc.pull') return text.pull(input as never);
    const more = { language: 'text', unsaved: false, ends: 'lf' };
    if (command === 'doc.open') return { ...text.state, text: text.text, ...more };
    throw new Error(`no such command: ${command}`);
  }

  /** A page has read that: what it tells of is in the journal. */
  heard(name: string, version: number): void {
    this.at(this.nameNow(name)).text.journal(version);
  }

  private at(name: string): HouseFile {
    const found = this.files.get(name);
    if (!found) throw new Error(`there is no ${name}`);
    return found;
  }

  private tell(): void {
    this.lines.forEach((line) => line.tell());
  }
}

/** A page and its link. */
export class Line implements World {
  readonly documents: Documents;
  private readonly connection: Connection;
  private events: SocketEvents | null = null;
  private readonly watches = new Map<number, string>();
  /** Nothing passes what was sent before. */
  private last = { up: 0, down: 0 };

  constructor(
    readonly number: number,
    private readonly house: House,
    private readonly schedule: Schedule,
    private readonly random: (below: number) => number,
  ) {
    const now = () => schedule.now;
    this.connection = new Connection(this, { token: '', client: `c${number}`, now });
    const later = (ms: number, act: () => void) => this.later(ms, act);
    const topics = new TopicCache(this.connection, later);
    this.documents = new Documents(this.connection, topics, { later, now, page: `p${number}` });
    house.lines.push(this);
    this.connection.start();
  }

  cut(): void {
    const { events } = this;
    this.events = null;
    this.watches.clear();
    events?.closed();
  }

  tell(): void {
    for (const [watch, doc] of this.watches) this.say({ watch, whole: this.house.documentOf(doc) });
  }

  connect(events: SocketEvents) {
    this.events = events;
    this.carry('down', () => {
      events.open();
      this.ping(events);
    });
    const send = (text: string) => this.carry('up', () => this.obey(JSON.parse(text) as Message));
    return { send, close: () => this.cut() };
  }

  later(milliseconds: number, act: () => void): () => void {
    let on = true;
    this.schedule.in(milliseconds, () => on && act());
    return () => (on = false);
  }

  frame(act: () => void): void {
    this.later(16, act);
  }

  chance(): number {
    return this.random(100) / 100;
  }

  post(): Promise<void> {
    return Promise.reject(new Error('there is no HTTP here'));
  }

  private ping(events: SocketEvents): void {
    if (this.events !== events) return;
    this.say({ ping: 1, now: this.schedule.now });
    this.schedule.in(kPingMs, () => this.ping(events));
  }

  private say(message: unknown, then = () => {}): void {
    const { events } = this;
    this.carry('down', () => {
      then();
      events?.text(JSON.stringify(message));
    });
  }

  /** Lost if the link is cut before it arrives. */
  private carry(way: 'up' | 'down', act: () => void): void {
    const { events, schedule } = this;
    const at = Math.max(this.last[way], schedule.now + this.random(20));
    this.last[way] = at;
    schedule.in(at - schedule.now, () => events !== null && this.events === events && act());
  }

  private obey(message: Message): void {
    const { id, do: command, in: input } = message;
    if (message.pong !== undefined) return;
    if (command === 'hello') return this.say({ id, ok: this.greeting() });
    if (command === 'watch') {
      const { doc } = input['of'] as { doc: string };
      this.watches.set(input['watch'] as number, doc);
      this.say({ id, ok: {} });
      return this.say({ watch: input['watch'], whole: this.house.documentOf(doc) });
    }
    if (command === 'unwatch') {
      this.watches.delete(input['watch'] as number);
      return this.say({ id, ok: {} });
    }
    try {
      const ok = this.house.answer(this.number, message) as { version: number };
      const doc = input['doc'] as string;
      this.say({ id, ok }, () => this.house.heard(doc, ok.version));
    } catch (error) {
      this.say({ id, error: { code: 'bad_input', what: String(error) } });
    }
  }

  private greeting() {
    const { number, schedule } = this;
    const more = { version: 't', role: 'drive', driver: true, wall: 0 };
    const epoch = this.house.texts[0]?.state.epoch;
    return { ...more, epoch, client: `c${number}`, number, now: schedule.now };
  }
}
