// The files that are open, each with one session that all its views share. A session stays until
// another project is open: its undo survives layouts, tabs and views.

import type { Doc, DocVersion, Problem } from '../protocol/messages';
import { answers, CommandError, type Connection } from './connection';
import { Emitter } from './emitter';
import { Fields } from './session/fields';
import type { OpenDocument } from './session/open';
import type { Ended } from './session/sync';
import type { Refusal, TextSession } from './session/text_session';
import type { DocLink } from './session/wire';
import type { TopicCache } from './topics';

export type { OpenDocument } from './session/open';

/** What the server says of a file is followed so long after its last view has gone. */
export const kStayMs = 120_000;
/** As many texts can be named with a command that changes several. */
export const kSeenMax = 2000;

interface Entry {
  doc: Doc;
  users: number;
  opened: Promise<OpenDocument>;
  /** The same, once it is there. */
  there: OpenDocument | null;
  unfollow: (() => void) | null;
  /** The file is not on disk. */
  isGone: boolean;
}

export interface DocumentsOptions {
  later(milliseconds: number, act: () => void): () => void;
  /** Milliseconds. */
  now(): number;
  /** A word for this life of the page. */
  page: string;
}

export class Documents {
  /** Something is unsent, or no longer. */
  readonly changed = new Emitter<void>();
  readonly refused = new Emitter<{ doc: Doc; refusal: Refusal }>();
  /** A file has another name; its session has gone with it. */
  readonly moved = new Emitter<{ from: Doc; to: Doc }>();
  readonly fields = new Fields();
  private readonly entries = new Map<Doc, Entry>();
  private edits = 0;
  /** What the server calls this page. */
  private number = 0;
  /** By folder: files of projects that were left with something that the server does not have. */
  private readonly left = new Map<string, Entry[]>();

  constructor(
    private readonly connection: Connection,
    private readonly topics: TopicCache,
    private readonly options: DocumentsOptions,
  ) {
    connection.changed.on((link) => {
      if (link.state === 'open') this.number = link.number;
      for (const { there } of this.entries.values()) there?.sync.linked(this.isLinked);
    });
    this.fields.changed.on(() => this.changed.emit());
  }

  /** Opens a file, or joins those who have; release() when it is no longer looked at. */
  acquire(doc: Doc): { opened: Promise<OpenDocument>; release: () => void } {
    const entry = this.entries.get(doc) ?? this.begin(doc);
    entry.users++;
    this.follow(entry);
    let held = true;
    const release = () => {
      if (held) this.release(entry);
      held = false;
    };
    return { opened: entry.opened, release };
  }

  /** Something was typed or drawn that the server does not have. */
  get isUnsent(): boolean {
    return this.fields.isTyped || [...this.entries.values()].some(isUnsent);
  }

  /** The same for one file. */
  waits(doc: Doc): boolean {
    const entry = this.entries.get(doc);
    return this.fields.isTypedFor(doc) || (entry !== undefined && isUnsent(entry));
  }

  /**
   * Takes what is typed in fields and sends what was not sent yet, in all files; gives the version of
   * each that the server then has. Throws with the reason if it does not get there.
   */
  flushAll(): Promise<Map<Doc, number>> {
    this.fields.settle();
    return this.flush(() => true);
  }

  /** The same for one file: what is wrong with another one is no reason not to save it. */
  flushOne(doc: Doc): Promise<void> {
    this.fields.settle();
    return this.sent(doc);
  }

  /**
   * What was typed goes first; gives the texts as this page has them then, for a command that is to
   * change just those. With a document: that one, also if what was done there is refused.
   */
  async seen(doc?: Doc): Promise<DocVersion[]> {
    if (doc === undefined) await this.flushAll();
    else await this.flushOne(doc).catch(() => {});
    const looked = [...this.entries.values()].filter(
      // Of those that nobody looks at, others may have made something else by now.
      (entry) => entry.unfollow && !entry.isGone && (doc === undefined || entry.doc === doc),
    );
    return looked
      .slice(0, kSeenMax)
      .flatMap(({ doc, there }) => (there ? { doc, ...there.sync.confirmed } : []));
  }

  /** The file of a session; it may have got another name. */
  docOf(session: TextSession): Doc | null {
    return [...this.entries.values()].find(({ there }) => there?.session === session)?.doc ?? null;
  }

  /** Why what was done in a file is not with the server, if that is so. */
  problemOf(doc: Doc): Problem | null {
    return this.entries.get(doc)?.there?.sync.problem ?? null;
  }

  /** A file that is looked at is not on disk. */
  get isGone(): boolean {
    return [...this.entries.values()].some((entry) => entry.users > 0 && entry.isGone);
  }

  /** Only sends what was not sent yet in one file: what is typed in a field goes on being typed. */
  async sent(doc: Doc): Promise<void> {
    await this.flush((one) => fileOf(one) === fileOf(doc));
  }

  /** A file has another name: its session, and who shows it, go with it. */
  renamed(from: Doc, to: Doc): void {
    if (from === to) return;
    const entry = this.entries.get(from);
    const other = this.entries.get(to);
    if (entry) this.drop(entry);
    // What was open under that name is another file, and gone: its text counts only if it was typed.
    if (entry && other && !isUnsent(other)) this.drop(other);
    if (entry && !this.entries.has(to)) {
      entry.doc = to;
      this.entries.set(to, entry);
      this.follow(entry, { isNewName: true });
    }
    this.moved.emit({ from, to });
  }

  /** This page may change things again: what was refused is sent. */
  tryAgain(): void {
    for (const { there } of this.entries.values())
      if (there?.sync.problem) void there.sync.flushed();
  }

  /**
   * Another project is open: what it calls by the same name is another file. What the server does not
   * have is kept until enter() of that folder; gives the names of those files.
   */
  leave(folder: string): Doc[] {
    const kept = [...this.entries.values()].filter(isUnsent);
    for (const entry of [...this.entries.values()]) {
      this.drop(entry);
      entry.there?.sync.linked(false);
    }
    if (kept.length > 0) this.left.set(folder, kept);
    this.changed.emit();
    return kept.map(({ doc }) => doc);
  }

  enter(folder: string): void {
    for (const entry of this.left.get(folder) ?? []) {
      this.entries.set(entry.doc, entry);
      this.follow(entry);
      entry.there?.sync.linked(this.isLinked);
      // Without a project it was refused.
      void entry.there?.sync.flushed();
    }
    this.left.delete(folder);
    this.changed.emit();
  }

  /** Files of other projects have something that the server does not have: it is in this page only. */
  get hasLeft(): boolean {
    return this.left.size > 0;
  }

  private async flush(is: (doc: Doc) => boolean): Promise<Map<Doc, number>> {
    const open = [...this.entries.values()].filter((entry) => entry.there && is(entry.doc));
    const all = await Promise.all(
      open.map(async ({ doc, there }) => ({ doc, ended: await there?.sync.flushed() })),
    );
    const versions = new Map<Doc, number>();
    for (const { doc, ended } of all) {
      if (ended?.is === 'sent') versions.set(doc, ended.version);
      else if (ended) throw new CommandError(whyNot(ended, doc));
    }
    return versions;
  }

  private get isLinked(): boolean {
    return answers(this.connection.link);
  }

  private begin(doc: Doc): Entry {
    const entry: Entry = {
      doc,
      users: 0,
      opened: this.open(doc),
      there: null,
      unfollow: null,
      isGone: false,
    };
    this.entries.set(doc, entry);
    entry.opened.then(
      (opened) => this.entered(entry, opened),
      () => this.drop(entry),
    );
    return entry;
  }

  private entered(entry: Entry, opened: OpenDocument): void {
    entry.there = opened;
    opened.sync.changed.on(() => this.changed.emit());
    opened.session.refused.on((refusal) => this.refused.emit({ doc: entry.doc, refusal }));
    opened.sync.linked(this.isLinked);
    this.told(entry);
  }

  private async open(doc: Doc): Promise<OpenDocument> {
    const [opened, { openDocument }] = await Promise.all([
      this.connection.send('doc.open', { doc }),
      import('./session/open'),
    ]);
    const name = () => `${this.options.page}.${++this.edits}`;
    // The name of the file may be another one by then.
    const nameNow = () => [...this.entries.values()].find((one) => one.there === made)?.doc ?? doc;
    const link: DocLink = {
      edit: (order) =>
        this.connection.send('doc.edit', {
          ...order,
          changes: [...order.changes],
          doc: nameNow(),
        }),
      pull: (from) => this.connection.send('doc.pull', { ...from, doc: nameNow() }),
    };
    const isAsked = (by: string) => by === `for:${this.number}`;
    const made = openDocument(opened, { link, name, isAsked, now: () => this.options.now() });
    return made;
  }

  private follow(entry: Entry, { isNewName = false } = {}): void {
    if (entry.unfollow) return;
    const of = { doc: entry.doc };
    entry.unfollow = this.topics.subscribe('doc', of, () => this.told(entry));
    // What was heard of that name before is older than that the file has it now.
    if (isNewName && this.topics.get('doc', of)?.moved !== undefined) return;
    this.told(entry);
  }

  private told(entry: Entry): void {
    const state = this.topics.get('doc', { doc: entry.doc });
    if (!state) return;
    if (entry.isGone !== state.gone) {
      entry.isGone = state.gone;
      this.changed.emit();
    }
    if (state.moved !== undefined) this.renamed(entry.doc, state.moved);
    // A file that is gone keeps its text.
    else if (state.version > 0) entry.there?.sync.told(state);
  }

  private drop(entry: Entry): void {
    entry.unfollow?.();
    entry.unfollow = null;
    if (this.entries.get(entry.doc) === entry) this.entries.delete(entry.doc);
  }

  private release(entry: Entry): void {
    entry.users--;
    if (entry.isGone) this.changed.emit();
    if (entry.users === 0) this.options.later(kStayMs, () => this.unfollowed(entry));
  }

  /** Nobody looks: it is asked again when somebody does. */
  private unfollowed(entry: Entry): void {
    if (entry.users > 0 || isUnsent(entry)) return;
    entry.unfollow?.();
    entry.unfollow = null;
  }
}

function isUnsent({ there }: Entry): boolean {
  return there?.sync.isUnsent ?? false;
}

function fileOf(doc: Doc): string {
  return doc.replace(/#\d+$/, '');
}

function whyNot(ended: Exclude<Ended, { is: 'sent' }>, doc: Doc): Problem {
  if (ended.is === 'refused') return { ...ended.problem, place: ended.problem.place ?? doc };
  return { code: 'unavailable', what: 'There is no connection. What was typed is kept here.' };
}
