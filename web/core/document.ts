// A text that is edited here and lives on the server. Typing is never held up: a change goes out at
// once, one message under way at a time; what others did meanwhile is woven in.
//
//   server's text --sent--> (under way) --unsent--> what is on the screen

import { ChangeSet, Text } from '@codemirror/state';
import type { Commands, Topics } from '../protocol/messages';
import { CommandError } from './connection';
import { Emitter } from './emitter';
import { textDiff } from './text_diff';

export type DocTopic = Topics['doc']['is'];

export interface DocLink {
  open(): Promise<Commands['doc.open']['out']>;
  edit(version: number, changes: Commands['doc.edit']['in']['changes']): Promise<number>;
}

export class SharedDocument {
  /** What others changed, to be applied to the text on the screen. */
  readonly remote = new Emitter<ChangeSet>();
  /** The editor may go on, or must not be changed any more. */
  readonly trouble = new Emitter<string>();

  private confirmed: Text;
  private version: number;
  private sent: ChangeSet | null = null;
  private unsent: ChangeSet | null = null;
  private latest: DocTopic | null = null;
  private settled: (() => void)[] = [];

  constructor(
    private readonly link: DocLink,
    opened: { text: string; version: number },
  ) {
    this.confirmed = textOf(opened.text);
    this.version = opened.version;
  }

  /** The text on the screen. */
  get text(): string {
    return this.local().toString();
  }

  /** The server's number of the text that it has from here. */
  get confirmedVersion(): number {
    return this.version;
  }

  get waits(): boolean {
    return this.sent !== null || this.unsent !== null;
  }

  /** A change that was made on the screen. */
  edit(change: ChangeSet): void {
    if (change.empty) return;
    this.unsent = this.unsent ? this.unsent.compose(change) : change;
    this.flush();
  }

  /** Resolves when the server has everything that was typed so far. */
  flushed(): Promise<void> {
    this.flush();
    return this.waits ? new Promise((resolve) => this.settled.push(resolve)) : Promise.resolve();
  }

  /**
   * What the topic "doc" says. Answers and topics come in order: while a change is under way this may
   * be from before it, and waits for its answer.
   */
  told(state: DocTopic): void {
    if (this.sent) this.latest = state;
    else if (state.version !== this.version) this.adopt(textOf(state.text), state.version);
  }

  private local(): Text {
    const there = this.sent ? this.sent.apply(this.confirmed) : this.confirmed;
    return this.unsent ? this.unsent.apply(there) : there;
  }

  private flush(): void {
    if (this.sent || !this.unsent) return;
    const sent = (this.sent = this.unsent);
    this.unsent = null;
    this.link.edit(this.version, changesOf(sent)).then(
      (version) => this.accepted(version),
      (error: unknown) => this.refused(error),
    );
  }

  private accepted(version: number): void {
    if (!this.sent) return;
    this.confirmed = this.sent.apply(this.confirmed);
    this.version = version;
    this.sent = null;
    this.takeLatest();
    this.next();
  }

  private refused(error: unknown): void {
    const problem = error instanceof CommandError ? error.problem : null;
    if (problem?.code !== 'conflict' && problem?.code !== 'bad_input') {
      this.trouble.emit(problem?.what ?? String(error));
      // The text stays on the screen; the next key tries again.
      this.unsent = joined(this.sent, this.unsent);
      this.sent = null;
      return;
    }
    this.link.open().then(
      (opened) => this.resync(opened.text, opened.version),
      (again: unknown) => this.refused(again instanceof CommandError ? again : error),
    );
  }

  /** The server's text is another one than we thought while ours was under way. */
  private resync(text: string, version: number): void {
    const server = textOf(text);
    // It took our change, and only the answer got lost.
    if (this.sent?.apply(this.confirmed).eq(server)) return this.accepted(version);
    this.unsent = joined(this.sent, this.unsent);
    this.sent = null;
    this.adopt(server, version);
    this.next();
  }

  /** What was told meanwhile counts only if it is newer than the answer. */
  private takeLatest(): void {
    const state = this.latest;
    this.latest = null;
    if (state && state.version > this.version) this.adopt(textOf(state.text), state.version);
  }

  /** Weaves the server's text into what is on the screen. */
  private adopt(server: Text, version: number): void {
    const theirs = ChangeSet.of(
      textDiff(this.confirmed.toString(), server.toString()),
      this.confirmed.length,
    );
    this.confirmed = server;
    this.version = version;
    if (!this.unsent) return theirs.empty ? undefined : this.remote.emit(theirs);
    const forScreen = theirs.map(this.unsent);
    this.unsent = this.unsent.map(theirs, true);
    if (!forScreen.empty) this.remote.emit(forScreen);
  }

  private next(): void {
    if (this.unsent) return this.flush();
    if (this.sent) return;
    for (const resolve of this.settled.splice(0)) resolve();
  }
}

function textOf(text: string): Text {
  return Text.of(text.split('\n'));
}

function joined(first: ChangeSet | null, second: ChangeSet | null): ChangeSet | null {
  return first && second ? first.compose(second) : (first ?? second);
}

function changesOf(set: ChangeSet): Commands['doc.edit']['in']['changes'] {
  const changes: Commands['doc.edit']['in']['changes'] = [];
  set.iterChanges((from, to, _fromAfter, _toAfter, inserted) =>
    changes.push({ from, to, text: inserted.toString() }),
  );
  return changes;
}
