// Samples of what is plotted: asked from the server while a plot is looked at, kept in rings.

import type { Happening, Node, NodeId } from '../protocol/messages';
import type { Connection } from './connection';
import { csvOf, type Cell } from './csv';
import { Emitter } from './emitter';
import type { Happenings } from './happenings';
import { kPlanName, kPlanNode, placeOf } from './picks';
import { numberOf, variableNamed } from './plan_view';
import { noPlot, sourceKey, sourceName, type Curve, type PlotState, type Source } from './plot';
import { align, Ring, type Aligned, type Span } from './ring';
import type { TopicCache } from './topics';
import { eachSample } from './values';

/** A plot whose panel is hidden goes on for so long: one looks something up and comes back. */
export const kPlotLingerMs = 30_000;
/** A plot is drawn at most so often. */
const kDrawMs = 40;
/** Right after the clock went back, what is later than it comes from the run before. */
const kOldRunMs = 1500;

interface PlotterWorld {
  frame(act: () => void): void;
  later(milliseconds: number, act: () => void): () => void;
  now(): number;
}

export class Plotter {
  /** What is plotted or how it is seen has changed. */
  readonly changed = new Emitter<void>();
  /** There are new samples; at most once for each painted frame. */
  readonly drawn = new Emitter<void>();
  state: PlotState = noPlot;
  /** Seconds that are looked at instead of the newest: zoomed, or paused. */
  held: Span | null = null;
  paused = false;
  /** The time until which the run is known. */
  newest = 0;

  private readonly rings = new Map<string, Ring>();
  private words = '';
  private sources: Source[] = [];
  private endWords: () => void = () => {};
  private endFollow: (() => void) | null = null;
  private cancelEnd: (() => void) | null = null;
  private followers = 0;
  private drawing = false;
  private wentBackAt = -Infinity;
  private readonly nodes = new Map<NodeId, () => void>();

  constructor(
    private readonly connection: Connection,
    private readonly topics: TopicCache,
    private readonly happenings: Happenings,
    private readonly world: PlotterWorld,
  ) {}

  set(state: PlotState): void {
    this.state = state;
    const keys = new Set(state.curves.map((curve) => sourceKey(curve.source)));
    for (const key of [...this.rings.keys()]) if (!keys.has(key)) this.rings.delete(key);
    this.ask();
    if (this.following) this.seePlan();
    this.changed.emit();
  }

  pause(paused: boolean): void {
    this.paused = paused;
    this.held = paused ? this.view() : null;
    this.changed.emit();
  }

  /** Shows these seconds; null: the newest again. */
  zoom(span: Span | null): void {
    this.held = span ?? (this.paused ? this.newestSpan() : null);
    this.changed.emit();
  }

  view(): Span {
    return this.held ?? this.newestSpan();
  }

  /** Samples are collected until the returned function is called. */
  follow(): () => void {
    this.followers++;
    this.cancelEnd?.();
    this.cancelEnd = null;
    this.endFollow ??= this.begin();
    return () => {
      if (--this.followers > 0) return;
      this.cancelEnd = this.world.later(kPlotLingerMs, () => {
        this.endFollow?.();
        this.endFollow = null;
      });
    };
  }

  ring({ source }: Curve): Ring {
    const key = sourceKey(source);
    const known = this.rings.get(key);
    if (known) return known;
    const made = new Ring();
    this.rings.set(key, made);
    return made;
  }

  data(most: number): Aligned & { span: Span } {
    const span = this.view();
    return {
      ...align(
        this.state.curves.map((curve) => this.ring(curve)),
        span,
        most,
      ),
      span,
    };
  }

  nameOf(source: Source): string {
    if (source.is === 'argument') return sourceName(source);
    const names = this.nodeNames().set(kPlanNode, kPlanName);
    const node = names.get(source.pick.node) ?? String(source.pick.node);
    return `${node}.${sourceName(source)}`;
  }

  /** What is in sight, one row for each time; a curve keeps its value until the next one. */
  rows(most: number): { head: string[]; rows: Cell[][] } {
    const { times, values } = align(
      this.state.curves.map((curve) => this.ring(curve)),
      this.view(),
      Infinity,
    );
    const from = Math.max(0, times.length - most);
    const held: (number | undefined)[] = values.map((column) => {
      const before = column.slice(0, from).findLast((value) => value !== null);
      return before ?? undefined;
    });
    const rows = times.slice(from).map((time, row): Cell[] => {
      values.forEach((column, index) => (held[index] = column[from + row] ?? held[index]));
      return [time, ...held];
    });
    return { head: ['time', ...this.state.curves.map((one) => this.nameOf(one.source))], rows };
  }

  csv(): string {
    const { head, rows } = this.rows(Infinity);
    return csvOf([head, ...rows]);
  }

  private newestSpan(): Span {
    // At the start of a run the axis is as long as later on.
    const to = Math.max(this.newest, this.state.span);
    return { from: to - this.state.span, to };
  }

  private nodeNames(): Map<NodeId, string> {
    const nodes: readonly Node[] = this.topics.get('robot', {})?.nodes ?? [];
    return new Map(nodes.map((node) => [node.id, node.name]));
  }

  private begin(): () => void {
    const ends = [
      this.happenings.follow((items) => this.heard(items)),
      this.topics.subscribe('clock', {}, () => this.told()),
      this.topics.subscribe('robot', {}, () => {}),
      this.topics.subscribe('plan', {}, () => this.seePlan()),
    ];
    this.heard(this.happenings.items);
    this.told();
    this.following = true;
    this.ask();
    return () => {
      this.following = false;
      this.ask();
      ends.forEach((end) => end());
    };
  }
  private following = false;

  /** Follows the descriptions of the nodes, and asks for the words that the names stand for now. */
  private ask(): void {
    const picks = this.following
      ? this.state.curves.flatMap(({ source }) =>
          source.is === 'word' && source.pick.node !== kPlanNode ? [source] : [],
        )
      : [];
    const wanted = new Set(picks.map(({ pick }) => pick.node));
    for (const [node, end] of this.nodes)
      if (!wanted.has(node)) {
        end();
        this.nodes.delete(node);
      }
    for (const node of wanted)
      if (!this.nodes.has(node))
        this.nodes.set(
          node,
          this.topics.subscribe('node', { node }, () => this.ask()),
        );
    const places = picks.flatMap((source) => {
      const { pick } = source;
      const place = placeOf(pick, this.topics.get('node', { node: pick.node })?.variables ?? []);
      return place ? [{ source, word: [pick.node, place.first] }] : [];
    });
    const words = JSON.stringify(places.map(({ word }) => word));
    if (words === this.words) return;
    this.words = words;
    this.sources = places.map(({ source }) => source);
    this.watchWords(places.map(({ word }) => word));
  }

  private watchWords(words: number[][]): void {
    this.endWords();
    this.endWords = () => {};
    if (words.length === 0) return;
    const rings = this.sources.map((source) => this.ring({ source, axis: 1, colour: 0 }));
    this.endWords = this.connection.watch(
      'samples',
      { words },
      {
        frame: (time, payload) => {
          eachSample(payload, (at, word, value) => this.sample(rings[word], at, value));
          this.passed(time);
        },
      },
    );
  }

  private heard(items: readonly Happening[]): void {
    for (const curve of this.state.curves) {
      const { source } = curve;
      if (source.is !== 'argument') continue;
      for (const { kind, name, t, args } of items)
        if (kind === 'event' && name === source.event && source.index < args.length)
          this.sample(this.ring(curve), t, args[source.index] ?? 0);
    }
  }

  /** Variables of the plan, as often as the page is told of them. */
  private seePlan(): void {
    const plan = this.topics.get('plan', {});
    if (!plan) return;
    for (const curve of this.state.curves) {
      const { source } = curve;
      if (source.is !== 'word' || source.pick.node !== kPlanNode) continue;
      const variable = variableNamed(plan.levels, source.pick.name);
      const value = variable && numberOf(variable.value);
      if (value !== undefined) this.sample(this.ring(curve), plan.t, value);
    }
  }

  private sample(ring: Ring | undefined, time: number, value: number): void {
    const old = this.world.now() - this.wentBackAt < kOldRunMs && time > this.newest + 1;
    if (!old && ring?.push(time, value)) this.passed(time);
  }

  private told(): void {
    const clock = this.topics.get('clock', {});
    if (!clock || clock.state === 'none') return;
    if (clock.t < this.newest - 1) {
      // The run began again: what was plotted belongs to the one before.
      for (const ring of this.rings.values()) ring.clear();
      this.newest = clock.t;
      this.held = null;
      this.paused = false;
      this.wentBackAt = this.world.now();
      this.watchWords(JSON.parse(this.words || '[]') as number[][]);
      this.changed.emit();
    }
    this.passed(clock.t);
  }

  private passed(time: number): void {
    const old = this.world.now() - this.wentBackAt < kOldRunMs && time > this.newest + 1;
    if (!old) this.newest = Math.max(this.newest, time);
    if (this.drawing) return;
    this.drawing = true;
    // Samples and the clock come at their own rates: they are drawn together.
    this.world.later(kDrawMs, () =>
      this.world.frame(() => {
        this.drawing = false;
        this.drawn.emit();
      }),
    );
  }
}

export interface Summary {
  last: number | undefined;
  least: number | undefined;
  most: number | undefined;
  mean: number | undefined;
}

/** A curve in words, over a span. The mean is that of its samples. */
export function summaryOf(ring: Ring, { from, to }: Span): Summary {
  let [least, most, sum, count] = [Infinity, -Infinity, 0, 0];
  for (let index = ring.from(from); index < ring.length && ring.time(index) <= to; index++) {
    const value = ring.value(index);
    least = Math.min(least, value);
    most = Math.max(most, value);
    sum += value;
    count++;
  }
  const last = ring.at(to);
  if (count === 0) return { last, least: last, most: last, mean: last };
  return { last, least, most, mean: sum / count };
}
