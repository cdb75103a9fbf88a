// Documents of the server that several places show at once: one subscription for all who look,
// ended a moment after the last one has gone. The value stays while the connection is lost.

import type { Json, TopicOf, Topics } from '../protocol/messages';
import type { Connection } from './connection';

/** How long a subscription outlives its last listener, so that changing a tab costs nothing. */
export const kLingerMs = 500;

export type DocumentTopic = TopicOf<'document'>;

interface Entry {
  topic: DocumentTopic;
  value: Json | undefined;
  listeners: Set<() => void>;
  end: () => void;
  again: () => void;
  cancelEnd: (() => void) | null;
}

export class TopicCache {
  private readonly entries = new Map<string, Entry>();

  constructor(
    private readonly connection: Connection,
    private readonly later: (milliseconds: number, act: () => void) => () => void,
  ) {}

  /** The last value that came; undefined until then. Made for useSyncExternalStore. */
  get<T extends DocumentTopic>(topic: T, of: Topics[T]['of']): Topics[T]['is'] | undefined {
    // What arrives is checked against the topic's shape in the connection.
    return this.entries.get(keyOf(topic, of))?.value as Topics[T]['is'] | undefined;
  }

  subscribe<T extends DocumentTopic>(
    topic: T,
    of: Topics[T]['of'],
    listener: () => void,
  ): () => void {
    const key = keyOf(topic, of);
    const entry = this.entries.get(key) ?? this.begin(key, topic, of);
    entry.cancelEnd?.();
    entry.cancelEnd = null;
    entry.listeners.add(listener);
    return () => {
      entry.listeners.delete(listener);
      if (entry.listeners.size > 0 || entry.cancelEnd) return;
      entry.cancelEnd = this.later(kLingerMs, () => this.drop(key, entry));
    };
  }

  /** The value once it is good, or what there is when that takes too long. */
  until<T extends DocumentTopic>(
    topic: T,
    of: Topics[T]['of'],
    good: (value: Topics[T]['is']) => boolean,
    withinMs: number,
  ): Promise<Topics[T]['is'] | undefined> {
    return new Promise((resolve) => {
      const value = () => this.get(topic, of);
      const finish = () => {
        cancel();
        end();
        resolve(value());
      };
      const look = () => {
        const now = value();
        if (now !== undefined && good(now)) finish();
      };
      const cancel = this.later(withinMs, finish);
      const end = this.subscribe(topic, of, look);
      look();
    });
  }

  /** Nothing is known of any topic but these until the server has said it again. */
  forget(but: readonly DocumentTopic[]): void {
    for (const entry of [...this.entries.values()].filter((one) => !but.includes(one.topic))) {
      entry.end();
      entry.value = undefined;
      entry.again();
      tell(entry);
    }
  }

  private begin<T extends DocumentTopic>(key: string, topic: T, of: Topics[T]['of']): Entry {
    const entry: Entry = {
      topic,
      value: undefined,
      listeners: new Set(),
      end: () => {},
      again: () => {},
      cancelEnd: null,
    };
    this.entries.set(key, entry);
    this.follow(entry, topic, of);
    return entry;
  }

  private follow<T extends DocumentTopic>(entry: Entry, topic: T, of: Topics[T]['of']): void {
    entry.end = this.connection.watch(topic, of, {
      value(value) {
        entry.value = value;
        tell(entry);
      },
    });
    entry.again = () => this.follow(entry, topic, of);
  }

  private drop(key: string, entry: Entry): void {
    entry.end();
    if (this.entries.get(key) === entry) this.entries.delete(key);
  }
}

function tell(entry: Entry): void {
  for (const listener of [...entry.listeners]) listener();
}

function keyOf(topic: string, of: object): string {
  return `${topic} ${JSON.stringify(of)}`;
}
