// Keeps the text of a session and the server's the same: one message under way at a time, what others
// did woven in, every wait ended.

import { diff } from '@codemirror/merge';
import { ChangeSet, type Text } from '@codemirror/state';
import type { Problem } from '../../protocol/messages';
import { CommandError } from '../connection';
import { Emitter } from '../emitter';
import type { TextSession } from './text_session';
import { changesOf, kChangesMax, specOf, type Answer, type Change, type DocLink } from './wire';

/** How a wait for the server ends. */
export type Ended =
  | { is: 'sent'; epoch: string; version: number }
  | { is: 'refused'; problem: Problem }
  | { is: 'disconnected' };

/** Of a text of the server. */
export interface Opened {
  epoch: string;
  version: number;
}

/** The first `count` of what is unsent, composed: under way, or nobody knows whether it was taken. */
interface Sending {
  by: string;
  count: number;
}

/** How far the diff of two texts looks before it takes all between as replaced. */
const kScanMax = 1000;

export class FileSync {
  /** Something is unsent, or no longer, or was refused. */
  readonly changed = new Emitter<void>();
  /** Why the last edit was not taken; it stays on the screen and goes with the next one. */
  problem: Problem | null = null;
  private epoch: string;
  private version: number;
  private sending: Sending | null = null;
  /** The message that is under way; answers to others come too late. */
  private underWay: object | null = null;
  private isLinked = true;
  /** The topic has told of another text than the one from here. */
  private isBehind = false;
  /** The whole text is asked for, once for each thing that was refused. */
  private startsAgain = false;
  private hasStartedAgain = false;
  private isReceiving = false;
  private waits: ((ended: Ended) => void)[] = [];

  /** `name`: a new word for each edit, unlike those of all other pages. */
  constructor(
    readonly session: TextSession,
    opened: Opened,
    private readonly link: DocLink,
    private readonly name: () => string,
    /** By its name: what the server did because this page asked for it. */
    private readonly isAsked: (by: string) => boolean = () => false,
  ) {
    this.epoch = opened.epoch;
    this.version = opened.version;
    session.followed.on(() => {
      if (this.isReceiving) return;
      this.tryAgain();
      this.go();
    });
  }

  /** Something that was done here is not with the server. */
  get isUnsent(): boolean {
    return this.session.unsent.length > 0;
  }

  get confirmed(): Opened {
    return { epoch: this.epoch, version: this.version };
  }

  /** Ends when the server has all that was done so far, or it is known that it does not get it. */
  flushed(): Promise<Ended> {
    this.tryAgain();
    this.go();
    const ended = this.ended();
    return ended ? Promise.resolve(ended) : new Promise((end) => this.waits.push(end));
  }

  /** What the topic "doc" says. */
  told({ epoch, version }: Opened): void {
    if (epoch === this.epoch && version <= this.version) return;
    this.isBehind = true;
    this.go();
  }

  linked(is: boolean): void {
    this.isLinked = is;
    this.go();
  }

  private tryAgain(): void {
    this.problem = null;
    this.hasStartedAgain = false;
  }

  private ended(): Ended | null {
    if (!this.isUnsent) return { is: 'sent', ...this.confirmed };
    if (this.session.isHeld) return { is: 'refused', problem: kHeld };
    if (this.problem) return { is: 'refused', problem: this.problem };
    return this.isLinked ? null : { is: 'disconnected' };
  }

  /** Sends the next message, if one is due and none is under way. */
  private go(): void {
    if (this.isLinked && !this.underWay) this.next();
    const ended = this.ended();
    if (ended) for (const end of this.waits.splice(0)) end(ended);
    this.changed.emit();
  }

  private next(): void {
    if (this.startsAgain || this.isBehind) this.pull();
    else if (this.isUnsent && !this.problem && !this.session.isHeld) this.send();
  }

  private pull(): void {
    // No epoch of the server has that name: it answers with the text.
    const epoch = this.startsAgain ? '' : this.epoch;
    this.startsAgain = false;
    this.isBehind = false;
    this.expect(this.link.pull({ epoch, version: this.version }), (answer) => this.take(answer));
  }

  private send(): void {
    const { unsent } = this.session;
    const sending = (this.sending ??= { by: this.name(), count: unsent.length });
    const { epoch, version } = this;
    const changes = fewer(composed(this.session, sending.count), this.session.confirmed);
    this.expect(this.link.edit({ epoch, version, by: sending.by, changes }), (answer) => {
      if (answer.behind === undefined && answer.text === undefined) this.taken(answer.version);
      else this.take(answer);
      // Not applied, or told by what was missing: the rest goes with the next edit.
      this.sending = null;
    });
  }

  private expect(answer: Promise<Answer>, take: (answer: Answer) => void): void {
    const own = (this.underWay = {});
    const end = (act: () => void) => {
      if (this.underWay !== own) return;
      this.underWay = null;
      this.receiving(act);
      this.go();
    };
    answer.then(
      (good) => end(() => this.understood(() => take(good))),
      (error: unknown) => end(() => this.refused(error)),
    );
  }

  private receiving(act: () => void): void {
    this.isReceiving = true;
    act();
    this.isReceiving = false;
  }

  /** An answer that does not fit the text from here is answered by asking for the whole text. */
  private understood(act: () => void): void {
    try {
      act();
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      this.refused(error);
    }
  }

  private taken(version: number): void {
    this.session.confirm(this.sending?.count ?? 0);
    this.version = version;
    this.sending = null;
    this.tryAgain();
  }

  private take({ version, behind, epoch, text }: Answer): void {
    if (text !== undefined) return this.startFrom(text, { epoch: epoch ?? this.epoch, version });
    for (const update of behind ?? []) {
      if (update.version <= this.version) continue;
      if (update.by === this.sending?.by) this.taken(update.version);
      else if (this.isAsked(update.by)) this.session.receiveOwn(this.changeOf(update.changes));
      else this.session.receive(this.changeOf(update.changes));
      this.version = update.version;
    }
  }

  private changeOf(changes: readonly Change[]): ChangeSet {
    return ChangeSet.of(specOf(changes), this.session.confirmed.length);
  }

  /** Three ways: what both had, what is here, and what the server has now. */
  private startFrom(text: string, opened: Opened): void {
    const { session } = this;
    const count = this.sending?.count ?? 0;
    const without = differences(session.confirmed.toString(), text);
    const own = composed(session, count);
    const having = differences(own.apply(session.confirmed).toString(), text);
    // Nobody has said whether it took what was under way: the text tells.
    const isTaken = count > 0 && sizeOf(having) < sizeOf(without) && isMostlyThere(own, having);
    if (isTaken) session.confirm(count);
    const theirs = isTaken ? having : without;
    session.receive(ChangeSet.of(theirs, session.confirmed.length));
    this.sending = null;
    this.epoch = opened.epoch;
    this.version = opened.version;
  }

  private refused(error: unknown): void {
    const problem: Problem =
      error instanceof CommandError ? error.problem : { code: 'failed', what: String(error) };
    const isInDoubt = kInDoubt.has(problem.code);
    if (!isInDoubt && !this.hasStartedAgain) {
      // The server before this one may have taken it, and its answer was lost: the text tells.
      this.hasStartedAgain = true;
      this.startsAgain = true;
      return;
    }
    // Without an answer nobody knows whether it was taken: it is asked again under the same name.
    if (!isInDoubt) this.sending = null;
    if (this.isLinked) this.problem = problem;
    // What was asked may have been a pull: it is asked again when the connection is back.
    else this.isBehind = true;
  }
}

const kInDoubt: ReadonlySet<string> = new Set(['timeout', 'unavailable']);

const kHeld: Problem = {
  code: 'bad_input',
  what: 'The text is not valid JSON: what was drawn waits until it is.',
};

function composed({ unsent, confirmed }: TextSession, count: number): ChangeSet {
  return unsent
    .slice(0, count)
    .map(({ changes }) => changes)
    .reduce((all, one) => all.compose(one), ChangeSet.empty(confirmed.length));
}

function differences(before: string, after: string) {
  return diff(before, after, { scanLimit: kScanMax }).map(({ fromA, toA, fromB, toB }) => ({
    from: fromA,
    to: toA,
    insert: after.slice(fromB, toB),
  }));
}

function sizeOf(changes: ReturnType<typeof differences>): number {
  return changes.reduce((sum, { from, to, insert }) => sum + to - from + insert.length, 0);
}

/**
 * At least half of what was inserted is left after those changes. A text that has nothing of it may still be
 * more like the one with it, if something was deleted as well; it is then inserted, rather than lost.
 */
function isMostlyThere(own: ChangeSet, after: ReturnType<typeof differences>): boolean {
  let inserted = 0;
  let there = 0;
  own.iterChanges((_fromA, _toA, from, to) => {
    inserted += to - from;
    there += to - from;
    for (const one of after) there -= Math.max(0, Math.min(to, one.to) - Math.max(from, one.from));
  }, true);
  return there * 2 >= inserted;
}

/** As many changes as fit into a message: more become one, with what lies between them. */
function fewer(set: ChangeSet, before: Text): Change[] {
  const changes = changesOf(set);
  const [first] = changes;
  const last = changes.at(-1);
  if (!first || !last || changes.length <= kChangesMax) return changes;
  const end = set.newLength - (set.length - last.to);
  return [{ from: first.from, to: last.to, text: set.apply(before).sliceString(first.from, end) }];
}
