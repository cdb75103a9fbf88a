// Words of nodes as they are now, for the rows on the screen. A row looks at the words of a variable
// and is told when they change, at most once for each frame that is painted; only what some row looks
// at is asked from the bus. Rows write what they are told into the page themselves: at 20 Hz and many
// nodes a rendering of components for each value would be too much.

import type { NodeId } from '../protocol/messages';
import type { Connection } from './connection';
import { Emitter } from './emitter';
import { eachRecord } from './values';

/** A changed value stays marked so long while its node runs. */
export const kMarkMs = 1000;
/** Rows come and go while a list is scrolled: the bus is asked when they have settled. */
export const kSettleMs = 80;
/** As many ranges of a node fit into one subscription. */
export const kRangesMax = 256;
/** Values of one node come at most so often. */
export const kWordsRate = 20;

export interface Look {
  node: NodeId;
  /** What is asked: the words of a whole variable, so that its elements share one range. */
  address: number;
  size: number;
  /** What is shown of it: words from this one on. */
  first: number;
  count: number;
}

export interface Seen {
  values: (number | undefined)[];
  /** Changed within the last second; while the node is paused: since it was paused last. */
  changed: boolean[];
  /** While the node is paused: what it was when it was paused last. */
  before: (number | undefined)[];
  /** The values are those of an instant of the past; before: what they are now. */
  past?: true;
}

export type WordThen = (node: NodeId, address: number) => number | undefined;

interface Looker {
  look: Look;
  show(seen: Seen): void;
}

interface NodeWords {
  words: Map<number, number>;
  changedAt: Map<number, number>;
  /** The words when the node went on last. */
  base: Map<number, number> | null;
  paused: boolean;
  lookers: Set<Looker>;
  asked: string;
  end: () => void;
  cancelSettle: (() => void) | null;
}

export interface WordsWorld {
  /** Calls before the next frame is painted. */
  frame(act: () => void): void;
  later(milliseconds: number, act: () => void): () => void;
  now(): number;
}

export class LiveWords {
  /** Other words are looked at. */
  readonly asked = new Emitter<void>();
  private then: WordThen | null = null;
  private readonly nodes = new Map<NodeId, NodeWords>();
  private readonly dirty = new Set<Looker>();
  private readonly marked = new Set<Looker>();
  private painting = false;
  private sweeping = false;

  constructor(
    private readonly connection: Connection,
    private readonly world: WordsWorld,
  ) {}

  /** Tells show() of the words until the returned function is called; at once of what is known. */
  look(look: Look, show: (seen: Seen) => void): () => void {
    const node = this.nodeOf(look.node);
    const looker: Looker = { look, show };
    node.lookers.add(looker);
    this.settle(look.node, node);
    show(this.seen(looker));
    return () => {
      node.lookers.delete(looker);
      this.dirty.delete(looker);
      this.marked.delete(looker);
      this.settle(look.node, node);
    };
  }

  /** A paused node keeps its marks; when it continues, what its words are then is the base. */
  pause(id: NodeId, paused: boolean): void {
    const node = this.nodeOf(id);
    if (node.paused === paused) return;
    node.paused = paused;
    if (!paused) node.base = new Map(node.words);
    for (const looker of node.lookers) this.dirty.add(looker);
    this.paint();
  }

  /** Shows words as they were; null: as they are. */
  showThen(then: WordThen | null): void {
    if (then === null && this.then === null) return;
    this.then = then;
    for (const node of this.nodes.values())
      for (const looker of node.lookers) this.dirty.add(looker);
    this.paint();
  }

  /** What is looked at, of all nodes: node, address, count. */
  ranges(): [NodeId, number, number][] {
    return [...this.nodes].flatMap(([id, { lookers }]) =>
      rangesOf([...lookers].map(({ look }) => look)).map(
        ([address, count]): [NodeId, number, number] => [id, address, count],
      ),
    );
  }

  value(node: NodeId, address: number): number | undefined {
    return this.nodes.get(node)?.words.get(address);
  }

  private nodeOf(id: NodeId): NodeWords {
    const known = this.nodes.get(id);
    if (known) return known;
    const made: NodeWords = {
      words: new Map(),
      changedAt: new Map(),
      base: null,
      paused: false,
      lookers: new Set(),
      asked: '',
      end: () => {},
      cancelSettle: null,
    };
    this.nodes.set(id, made);
    return made;
  }

  private settle(id: NodeId, node: NodeWords): void {
    if (node.cancelSettle) return;
    node.cancelSettle = this.world.later(kSettleMs, () => {
      node.cancelSettle = null;
      this.ask(id, node);
    });
  }

  private ask(id: NodeId, node: NodeWords): void {
    const ranges = rangesOf([...node.lookers].map((looker) => looker.look));
    const asked = JSON.stringify(ranges);
    if (asked === node.asked) return;
    node.asked = asked;
    this.asked.emit();
    const endBefore = node.end;
    node.end = () => {};
    // The new one comes before the old one ends: what both ask for is not interrupted.
    if (ranges.length > 0)
      node.end = this.connection.watch(
        'variables',
        { node: id, ranges },
        { frame: (_time, payload) => this.received(node, payload) },
        kWordsRate,
      );
    endBefore();
  }

  private received(node: NodeWords, payload: DataView): void {
    eachRecord(payload, (address, count, valueAt) => {
      if (this.store(node, address, count, valueAt))
        for (const looker of node.lookers)
          if (overlaps(looker.look, address, count)) this.dirty.add(looker);
    });
    if (this.dirty.size > 0) this.paint();
  }

  private store(
    node: NodeWords,
    address: number,
    count: number,
    valueAt: (index: number) => number,
  ): boolean {
    let differs = false;
    for (let index = 0; index < count; index++) {
      const value = valueAt(index);
      const before = node.words.get(address + index);
      if (before === value) continue;
      differs = true;
      node.words.set(address + index, value);
      if (before !== undefined) node.changedAt.set(address + index, this.world.now());
    }
    return differs;
  }

  private paint(): void {
    if (this.painting) return;
    this.painting = true;
    this.world.frame(() => {
      this.painting = false;
      for (const looker of this.dirty) this.tell(looker);
      this.dirty.clear();
    });
  }

  private tell(looker: Looker): void {
    const seen = this.seen(looker);
    if (seen.changed.some(Boolean)) this.marked.add(looker);
    looker.show(seen);
    if (this.marked.size > 0) this.sweep();
  }

  /** Marks go a second after their change. */
  private sweep(): void {
    if (this.sweeping) return;
    this.sweeping = true;
    this.world.later(kMarkMs / 4, () => {
      this.sweeping = false;
      for (const looker of [...this.marked]) {
        const seen = this.seen(looker);
        if (seen.changed.some(Boolean)) continue;
        this.marked.delete(looker);
        looker.show(seen);
      }
      if (this.marked.size > 0) this.sweep();
    });
  }

  private seen({ look }: Looker): Seen {
    const node = this.nodeOf(look.node);
    const now = this.world.now();
    if (this.then) return seenThen(look, node.words, this.then);
    const seen: Seen = { values: [], changed: [], before: [] };
    for (let address = look.first; address < look.first + look.count; address++) {
      const value = node.words.get(address);
      const base = node.paused ? node.base?.get(address) : undefined;
      seen.values.push(value);
      seen.before.push(base);
      seen.changed.push(
        node.paused
          ? base !== undefined && base !== value
          : now - (node.changedAt.get(address) ?? -Infinity) < kMarkMs,
      );
    }
    return seen;
  }
}

/** As they were, beside what they are. */
function seenThen(look: Look, now: ReadonlyMap<number, number>, then: WordThen): Seen {
  const addresses = Array.from({ length: look.count }, (_, index) => look.first + index);
  return {
    values: addresses.map((address) => then(look.node, address)),
    changed: addresses.map(() => false),
    before: addresses.map((address) => now.get(address)),
    past: true,
  };
}

/** One range for each variable that is looked at, by address. */
export function rangesOf(looks: readonly Look[]): [number, number][] {
  const sizes = new Map<number, number>();
  for (const { address, size } of looks)
    sizes.set(address, Math.max(size, sizes.get(address) ?? 0));
  return [...sizes].sort(([a], [b]) => a - b).slice(0, kRangesMax);
}

function overlaps(look: Look, address: number, count: number): boolean {
  return look.first < address + count && address < look.first + look.count;
}
