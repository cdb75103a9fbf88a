// What is shown: now, or an instant of the past. One cursor for all panels of this page; an instant
// is asked from the server, the newest wish only, while the run goes on.

import { misfit } from '../protocol/check';
import {
  topicTable,
  type Commands,
  type NodeId,
  type Path,
  type Topics,
} from '../protocol/messages';
import type { Connection } from './connection';
import { Emitter } from './emitter';
import { PastSettings } from './past_settings';
import type { TopicCache } from './topics';

export type Instant = Commands['history.at']['out'];
export type PlanThen = Topics['plan']['is'];

/** The keys go so far at a time, in seconds; so often the server looks at a world. */
export const kPastStep = 0.02;
/** So many of the last happenings come with an instant. */
export const kPastEvents = 300;

export interface OpenTrace {
  path: Path;
  from: number;
  to: number;
  /** Those with projects of their own, and whose plan is shown. */
  robots: readonly string[];
  robot?: string;
  /** The world that it was recorded in. */
  scene?: Topics['scene']['is'];
}

/** What a view shows of then beside words and poses: where sensors looked, or what a camera saw. */
export interface Sights {
  rays?: true;
  /** Of that robot. */
  picture?: string;
}

/** Words of a node that somebody shows: [node, address, count]. */
export type Range = [node: NodeId, address: number, count: number];

export class Past {
  /** The cursor, the instant that is shown, or the trace has changed. */
  readonly changed = new Emitter<void>();
  readonly failed = new Emitter<unknown>();
  /** The cursor, in seconds; null: now. */
  at: number | null = null;
  /** The instant that the views show: the previous one until the answer for `at` arrives. */
  shown: number | null = null;
  /** What came of it last; null until then. */
  instant: Instant | null = null;
  /** Its plan; null: none ran. */
  plan: PlanThen | null = null;
  /** A trace that was opened as a file: nothing runs. */
  trace: OpenTrace | null = null;
  /** What variables of the plan are to be when the run goes on from there. */
  readonly settings = new PastSettings();

  private readonly sights = new Set<Sights>();
  private asking = false;
  private askAgain = false;
  private words = new Map<NodeId, ReadonlyMap<number, number>>();
  private run: number | null = null;

  constructor(
    private readonly connection: Connection,
    private readonly topics: TopicCache,
    private readonly ranges: () => Range[],
  ) {}

  /** Until when something is known. */
  get end(): number {
    return this.trace?.to ?? this.topics.get('history', {})?.to ?? 0;
  }

  get start(): number {
    return this.trace?.from ?? this.topics.get('history', {})?.from ?? 0;
  }

  /** Shows that instant. What is not over yet cannot be looked at. */
  look(t: number): void {
    this.at = Math.min(Math.max(t, this.start), this.end);
    this.changed.emit();
    this.ask();
  }

  /** So many seconds on; backwards also from now. */
  step(by: number): void {
    this.look(Math.round(((this.at ?? this.end) + by) * 1e6) / 1e6);
  }

  /** To where the plan made its next step, or the one before; behind its last one to the end, before its first one to the beginning. */
  async stepOfPlan(forward: boolean): Promise<void> {
    const t = this.at ?? this.end;
    const out = await this.connection.send('history.at', this.input(t, 0));
    this.look((forward ? out.next : out.before) ?? (forward ? this.end : this.start));
  }

  /** Now again; from a trace there is no now, it stays open. */
  back(): void {
    if (this.trace) return this.closeTrace();
    this.at = null;
    this.forget();
  }

  /** What the trace is asked as; nothing: it is the run. */
  get asked(): { trace?: Path; robot?: string } {
    if (!this.trace) return {};
    const { path, robot } = this.trace;
    return robot === undefined ? { trace: path } : { trace: path, robot };
  }

  /** At its beginning, or at that instant. */
  async openTrace(
    path: Path,
    robot?: string,
    at?: number,
  ): Promise<Commands['history.open']['out']> {
    const opened = await this.connection.send('history.open', {
      trace: path,
      ...(robot === undefined ? {} : { robot }),
    });
    const { from, to, robots = [], scene } = opened;
    this.trace = { path, from, to, robots };
    if (opened.robot !== undefined) this.trace.robot = opened.robot;
    if (scene !== undefined && misfit(scene, topicTable.scene.is ?? {}) === '')
      this.trace.scene = scene as unknown as Topics['scene']['is'];
    this.look(at ?? from);
    return opened;
  }

  closeTrace(): void {
    this.trace = null;
    this.at = null;
    this.forget();
  }

  /** Another run has begun: its past is another one. */
  told(): void {
    const run = this.topics.get('history', {})?.run ?? null;
    const another = this.run !== null && run !== this.run;
    this.run = run;
    if (another && !this.trace && this.at !== null) this.back();
  }

  /** A word as it was; undefined: not recorded. */
  value(node: NodeId, address: number): number | undefined {
    return this.words.get(node)?.get(address);
  }

  /** From now on an instant comes with them, until the returned function is called. */
  wants(sights: Sights): () => void {
    this.sights.add(sights);
    this.ask();
    return () => this.sights.delete(sights);
  }

  /** Rows have come into sight: their words of that instant are asked for, too. */
  ask(): void {
    if (this.at === null) return;
    if (this.asking) {
      this.askAgain = true;
      return;
    }
    void this.fetch(this.at);
  }

  private async fetch(t: number): Promise<void> {
    this.asking = true;
    try {
      const instant = await this.connection.send('history.at', this.input(t, kPastEvents));
      if (this.at !== null) this.show(instant, t);
    } catch (problem) {
      this.failed.emit(problem);
    }
    this.asking = false;
    if (!this.askAgain) return;
    this.askAgain = false;
    this.ask();
  }

  private input(t: number, events: number): Commands['history.at']['in'] {
    const sights: Sights = {};
    for (const one of this.sights) Object.assign(sights, one);
    return { t, events, ranges: this.ranges(), ...sights, ...this.asked };
  }

  private show(instant: Instant, t: number): void {
    this.instant = instant;
    this.shown = t;
    const { plan } = instant;
    const good = plan !== undefined && misfit(plan, topicTable.plan.is ?? {}) === '';
    this.plan = good ? (plan as unknown as PlanThen) : null;
    this.words = new Map();
    for (const { node, address, words } of instant.values) {
      const known = new Map(this.words.get(node));
      words.forEach((word, index) => {
        if (typeof word === 'number') known.set(address + index, word);
      });
      this.words.set(node, known);
    }
    this.changed.emit();
  }

  private forget(): void {
    this.settings.clear();
    this.instant = null;
    this.shown = null;
    this.plan = null;
    this.words = new Map();
    this.changed.emit();
  }
}
