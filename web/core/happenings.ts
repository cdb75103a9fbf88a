// What happened on the bus and in the plan: the newest ones, counted. One subscription for all who
// look (the list of events, plots of arguments); they are told at most once for each painted frame.

import type { Happening, NodeId } from '../protocol/messages';
import type { Connection } from './connection';
import { Emitter } from './emitter';

/** As many are kept in the page. */
export const kHappeningsMax = 20_000;
/** Asked again when somebody begins to look. */
export const kHappeningsLast = 2000;
/** A subscription outlives its last looker by so long: tabs are changed back and forth. */
export const kHappeningsLingerMs = 2000;

export interface Count {
  name: string;
  source: string;
  count: number;
  last: Happening;
  /** By the second, over the last seconds. */
  rate: number;
}

export class Happenings {
  readonly changed = new Emitter<void>();
  /** In the order of their numbers. */
  items: Happening[] = [];
  /** What the server left out because this page or the network was slow. */
  leftOut = 0;
  private readonly counts = new Map<string, { count: number; last: Happening; times: number[] }>();
  private readonly fresh = new Emitter<readonly Happening[]>();
  private lookers = 0;
  private end: (() => void) | null = null;
  private cancelEnd: (() => void) | null = null;
  private telling = false;

  constructor(
    private readonly connection: Connection,
    private readonly world: {
      frame(act: () => void): void;
      later(milliseconds: number, act: () => void): () => void;
    },
  ) {
    // Numbers are those of the server's life.
    connection.renewed.on(() => {
      this.clear();
      this.cleared = -1;
    });
  }

  /** Follows what happens until the returned function is called. each: of new ones as they come. */
  follow(each?: (items: readonly Happening[]) => void): () => void {
    this.lookers++;
    this.cancelEnd?.();
    this.cancelEnd = null;
    const endEach = each ? this.fresh.on(each) : () => {};
    this.end ??= this.connection.watch(
      'happenings',
      { last: kHappeningsLast },
      // The connection has checked each item against the topic.
      { items: (items, left) => this.received(items as unknown as Happening[], left) },
    );
    return () => {
      endEach();
      if (--this.lookers > 0) return;
      this.cancelEnd = this.world.later(kHappeningsLingerMs, () => {
        this.end?.();
        this.end = null;
      });
    };
  }

  /** Forgets what was seen; what comes again from the server is not shown again. */
  clear(): void {
    this.cleared = Math.max(this.cleared, this.items.at(-1)?.number ?? this.cleared);
    this.items = [];
    this.counts.clear();
    this.leftOut = 0;
    this.tell();
  }
  private cleared = -1;

  /** Most frequent first. */
  countList(): Count[] {
    return [...this.counts.values()]
      .map(({ count, last, times }) => ({
        name: last.name || last.kind,
        source: last.source,
        count,
        last,
        rate: rateOf(times),
      }))
      .sort((a, b) => b.count - a.count);
  }

  private received(items: readonly Happening[], leftOut: number): void {
    this.leftOut += leftOut;
    const known = Math.max(this.items.at(-1)?.number ?? -1, this.cleared);
    const fresh = items.filter((item) => item.number > known);
    if (fresh.length === 0 && leftOut === 0) return;
    this.items =
      this.items.length + fresh.length > kHappeningsMax
        ? [...this.items, ...fresh].slice(-kHappeningsMax)
        : this.items.concat(fresh);
    for (const item of fresh) this.count(item);
    if (fresh.length > 0) this.fresh.emit(fresh);
    this.tell();
  }

  private count(item: Happening): void {
    const key = `${item.kind} ${item.name} ${item.source}`;
    const entry = this.counts.get(key) ?? { count: 0, last: item, times: [] };
    entry.count++;
    entry.last = item;
    entry.times.push(item.t);
    if (entry.times.length > kRateOver) entry.times.shift();
    this.counts.set(key, entry);
  }

  private tell(): void {
    if (this.telling) return;
    this.telling = true;
    this.world.frame(() => {
      this.telling = false;
      this.changed.emit();
    });
  }
}

/** A rate is that of so many of the last ones. */
const kRateOver = 16;

function rateOf(times: readonly number[]): number {
  const [first, last] = [times[0] ?? 0, times.at(-1) ?? 0];
  return last > first ? (times.length - 1) / (last - first) : 0;
}

export type HappeningKind = Happening['kind'];
export const happeningKinds: readonly HappeningKind[] = [
  'event',
  'state',
  'fault',
  'appeared',
  'gone',
  'loaded',
  'plan',
  'lost',
];

export interface EventFilter {
  /** Words, each in the name, the source or the text; "-word" for what is not wanted. */
  find: string;
  node: NodeId | null;
  kinds: readonly HappeningKind[];
}

export const allEvents: EventFilter = { find: '', node: null, kinds: happeningKinds };

export function passes(filter: EventFilter): (item: Happening) => boolean {
  const words = filter.find.toLowerCase().split(/\s+/).filter(Boolean);
  const wanted = words.filter((word) => !word.startsWith('-'));
  const not = words.flatMap((word) => (/^-./.test(word) ? [word.slice(1)] : []));
  const kinds = new Set(filter.kinds);
  return (item) => {
    if (!kinds.has(item.kind) || (filter.node !== null && item.node !== filter.node)) return false;
    if (words.length === 0) return true;
    const text = `${item.name} ${item.source} ${item.text}`.toLowerCase();
    return wanted.every((word) => text.includes(word)) && !not.some((word) => text.includes(word));
  };
}

/** Looks only at what is new since it was asked last: a list of thousands is not gone through again. */
export class Filtered {
  private shown: Happening[] = [];
  private seen: Happening | undefined;
  private test: ((item: Happening) => boolean) | null = null;

  of(items: readonly Happening[], test: (item: Happening) => boolean): readonly Happening[] {
    const at = this.seen ? items.lastIndexOf(this.seen) : -1;
    if (test !== this.test || at < 0) this.shown = items.filter(test);
    else if (at < items.length - 1)
      this.shown = [...this.shown, ...items.slice(at + 1).filter(test)];
    const first = items[0]?.number ?? Infinity;
    if ((this.shown[0]?.number ?? Infinity) < first)
      this.shown = this.shown.filter((item) => item.number >= first);
    this.test = test;
    this.seen = items.at(-1);
    return this.shown;
  }
}
