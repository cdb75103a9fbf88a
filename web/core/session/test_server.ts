// A server of one file and links to it, in this process: the clock and what the links do to messages
// are the test's.

import { ChangeSet, Text } from '@codemirror/state';
import { CommandError } from '../connection';
import { FileSync } from './sync';
import { TextSession } from './text_session';
import { changesOf, specOf, type Answer, type DocLink, type Update } from './wire';

type Order = Parameters<DocLink['edit']>[0];

export class ModelServer {
  epoch = 1;
  version = 1;
  readonly told: (() => void)[] = [];
  /** So many edits are refused. */
  refuses = 0;
  private log: Update[] = [];
  /** Texts by their versions, from the one on that is in the journal. */
  private texts = new Map<number, string>();
  private readonly answers = new Map<string, Answer>();

  constructor(public text: string) {}

  /** `name`: the client and the number of its command, which is done once. */
  edit(name: string, order: Order): Answer {
    const known = this.answers.get(name);
    if (known) return known;
    if (this.refuses > 0) {
      this.refuses--;
      throw new Error('refused');
    }
    const missing = this.missing(order);
    const answer = missing ?? { version: this.apply(order.by, order.changes) };
    this.answers.set(name, answer);
    return answer;
  }

  pull(from: { epoch: string; version: number }): Answer {
    return this.missing(from) ?? { version: this.version, behind: [] };
  }

  apply(by: string, changes: Order['changes']): number {
    const before = this.text;
    const set = ChangeSet.of(specOf(changes), before.length);
    this.text = set.apply(Text.of(this.text.split('\n'))).toString();
    this.texts.set(this.version, before);
    this.log.push({ version: ++this.version, by, changes: changesOf(set) });
    this.told.forEach((tell) => tell());
    return this.version;
  }

  /** Somebody has heard of that text: it is in the journal. */
  journal(version: number): void {
    for (const old of this.texts.keys()) if (old < version) this.texts.delete(old);
  }

  /** What was acknowledged is in the journal; what was answered is forgotten. */
  restart({ loses = false } = {}): void {
    // The oldest is what is in the journal; what came after it was never acknowledged.
    if (loses) this.text = this.texts.values().next().value ?? this.text;
    this.texts.clear();
    this.epoch++;
    this.version = 1;
    this.log = [];
    this.answers.clear();
    this.told.forEach((tell) => tell());
  }

  /** Of what was before, nothing is known any more. */
  forget(): void {
    this.log = [];
  }

  get state() {
    return { epoch: String(this.epoch), version: this.version };
  }

  private missing({ epoch, version }: { epoch: string; version: number }): Answer | null {
    const whole = { ...this.state, text: this.text };
    if (epoch !== String(this.epoch) || version > this.version) return whole;
    if (version === this.version) return null;
    const behind = this.log.filter((one) => one.version > version);
    return behind.length < this.version - version ? whole : { version: this.version, behind };
  }
}

/** Acts that are due, in the order of their time. */
export class Schedule {
  now = 0;
  private due: { at: number; act: () => void }[] = [];

  in(delay: number, act: () => void): void {
    this.due.push({ at: this.now + delay, act });
  }

  async advance(ms: number): Promise<void> {
    const end = this.now + ms;
    for (;;) {
      const next = Math.min(...this.due.map(({ at }) => at));
      if (next > end) break;
      const index = this.due.findIndex(({ at }) => at === next);
      const [one] = this.due.splice(index, 1);
      this.now = next;
      one?.act();
      // Answers reach who waits for them.
      for (let turn = 0; turn < 4; turn++) await Promise.resolve();
    }
    this.now = end;
  }
}

interface Waiting {
  ask: () => Answer;
  done: (answer: Answer) => void;
  failed: (error: unknown) => void;
}

/** A page with one session; its messages are late, lost, doubled and out of order as `delay` says. */
export class ModelPage {
  readonly session: TextSession;
  readonly sync: FileSync;
  private life = 0;
  private isUp = true;
  private commands = 0;
  private edits = 0;
  private readonly waiting = new Map<number, Waiting>();

  constructor(
    readonly name: string,
    private readonly server: ModelServer,
    private readonly schedule: Schedule,
    private readonly delay: () => number,
    language = 'text',
  ) {
    this.session = new TextSession(server.text, language);
    const link: DocLink = {
      edit: (order) => this.ask((number) => server.edit(`${name} ${number}`, order)),
      pull: (from) => this.ask(() => server.pull(from)),
    };
    this.sync = new FileSync(
      this.session,
      server.state,
      link,
      () => `${name}.${++this.edits}`,
      (by) => by === `for:${name}`,
    );
    server.told.push(() => this.tell());
  }

  cut(): void {
    this.isUp = false;
    this.life++;
    this.sync.linked(false);
  }

  /** What was not answered is asked again. */
  join(): void {
    if (this.isUp) return;
    this.isUp = true;
    this.life++;
    for (const number of this.waiting.keys()) this.carry(number);
    this.sync.linked(true);
    this.tell();
  }

  private ask(act: (number: number) => Answer): Promise<Answer> {
    const number = ++this.commands;
    return new Promise((done, failed) => {
      this.waiting.set(number, { ask: () => act(number), done, failed });
      if (this.isUp) this.carry(number);
    });
  }

  private carry(number: number): void {
    this.later(() => {
      const one = this.waiting.get(number);
      if (!one) return;
      let answer: Answer;
      try {
        answer = one.ask();
      } catch (error) {
        const refusal = new CommandError({ code: 'bad_input', what: String(error) });
        return this.later(() => this.waiting.delete(number) && one.failed(refusal));
      }
      const deliver = () => {
        if (!this.waiting.delete(number)) return;
        this.server.journal(answer.version);
        one.done(answer);
      };
      this.later(deliver);
      // Doubled now and then.
      if (this.delay() % 3 === 0) this.later(deliver);
    });
  }

  private tell(): void {
    const { state } = this.server;
    this.later(() => this.sync.told(state));
  }

  /** Lost if the link is cut before it arrives. */
  private later(act: () => void): void {
    const { life } = this;
    this.schedule.in(this.delay(), () => this.isUp && this.life === life && act());
  }
}
