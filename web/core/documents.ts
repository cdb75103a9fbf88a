// The texts that are open, each shared by all views of it, dropped when the last view has gone and
// the server has everything.

import type { Doc } from '../protocol/messages';
import type { Connection } from './connection';
import { SharedDocument } from './document';
import type { TopicCache } from './topics';

export interface OpenDocument {
  shared: SharedDocument;
  language: string;
  /** What an editor wants to find again when it is shown next: its history of undo, its place. */
  kept: unknown;
}

/** A text stays open so long after its last view has gone: a tab moves, a layout changes. */
export const kStayMs = 120_000;

interface Entry {
  users: number;
  opened: Promise<OpenDocument>;
  end: () => void;
}

export class Documents {
  private readonly entries = new Map<Doc, Entry>();
  private readonly others = new Set<() => Promise<void>>();

  constructor(
    private readonly connection: Connection,
    private readonly topics: TopicCache,
    private readonly later: (milliseconds: number, act: () => void) => () => void,
  ) {}

  /** Opens a text, or joins those who have; release() when it is no longer looked at. */
  acquire(doc: Doc): { opened: Promise<OpenDocument>; release: () => void } {
    const entry = this.entries.get(doc) ?? this.begin(doc);
    entry.users++;
    let held = true;
    const release = () => {
      if (held) this.release(doc, entry);
      held = false;
    };
    return { opened: entry.opened, release };
  }

  /** What else is edited is sent with the texts: files that are edited by their members. */
  join(flushed: () => Promise<void>): () => void {
    this.others.add(flushed);
    return () => void this.others.delete(flushed);
  }

  /** Sends what was typed and not yet sent, in all texts; gives the version of each that the server then has. */
  async flushAll(): Promise<Map<Doc, number>> {
    await Promise.allSettled([...this.others].map((flushed) => flushed()));
    const flushed = await Promise.allSettled(
      [...this.entries].map(async ([doc, entry]): Promise<[Doc, number]> => {
        const { shared } = await entry.opened;
        await shared.flushed();
        return [doc, shared.confirmedVersion];
      }),
    );
    return new Map(flushed.flatMap((one) => (one.status === 'fulfilled' ? [one.value] : [])));
  }

  /** Another project is open: what it calls by the same name is another text. */
  forget(): void {
    for (const entry of this.entries.values()) entry.end();
    this.entries.clear();
  }

  private begin(doc: Doc): Entry {
    const entry: Entry = { users: 0, opened: this.open(doc), end: () => {} };
    this.entries.set(doc, entry);
    entry.opened.then(
      ({ shared }) => {
        if (this.entries.get(doc) !== entry) return;
        // Shared with all who show something of it: the whole text comes with each change. What is
        // there already is from before the answer, and older.
        entry.end = this.topics.subscribe('doc', { doc }, () => {
          const state = this.topics.get('doc', { doc });
          if (state) shared.told(state);
        });
      },
      () => this.entries.get(doc) === entry && this.entries.delete(doc),
    );
    return entry;
  }

  private async open(doc: Doc): Promise<OpenDocument> {
    const opened = await this.connection.send('doc.open', { doc });
    const shared = new SharedDocument(
      {
        open: () => this.connection.send('doc.open', { doc }),
        edit: async (version, changes) =>
          (await this.connection.send('doc.edit', { doc, version, changes })).version,
      },
      opened,
    );
    return { shared, language: opened.language, kept: null };
  }

  private release(doc: Doc, entry: Entry): void {
    entry.users--;
    if (entry.users === 0) this.later(kStayMs, () => this.finish(doc, entry));
  }

  private finish(doc: Doc, entry: Entry): void {
    void entry.opened.then(async ({ shared }) => {
      if (entry.users > 0) return;
      await shared.flushed();
      if (entry.users > 0 || this.entries.get(doc) !== entry) return;
      entry.end();
      this.entries.delete(doc);
    });
  }
}
