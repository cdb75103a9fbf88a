// What a page does with a fleet: how it looks at the robots, and what it tells them.

import type { Commands, FleetEvent, FleetOutcome, Path } from '../protocol/messages';
import { deskFor } from './desk';
import { Emitter } from './emitter';
import { inBatches, noChoice, type Choice, type Sort } from './fleet';
import type { Studio } from './studio';
import { whyOf } from './why';

export const kFleetEventsKept = 5000;
/** Of a roll-out: how many robots have the version after each step. */
export const kStepsUnlessTold = '1,10%,100%';

export type Verb = Commands['fleet.order']['in']['verb'] | 'stop';
/** Of set and emit: what, with which values. */
export type OrderWords = Omit<Commands['fleet.order']['in'], 'verb' | 'robots'>;

type Progress =
  | { is: 'sent' }
  | { is: 'answered'; outcomes: readonly FleetOutcome[] }
  | { is: 'failed'; why: string };
/** An order of this page: under way, answered, or not given. */
export type Report = { verb: Verb; robots: number | 'all' } & Progress;

export interface EventFilter {
  readonly find: string;
  readonly kinds: readonly FleetEvent['kind'][];
  /** Only of the robots that are chosen. */
  readonly chosen: boolean;
}

export const eventKinds: readonly FleetEvent['kind'][] = ['event', 'connection', 'order'];

export class FleetDesk {
  readonly changed = new Emitter<void>();
  readonly eventsChanged = new Emitter<void>();
  choice: Choice = noChoice;
  query = '';
  sort: Sort = 'name';
  filter: EventFilter = { find: '', kinds: eventKinds, chosen: false };
  report: Report | null = null;
  events: readonly FleetEvent[] = [];
  leftOut = 0;
  /** Why the last version was not deployed, or its roll-out not stopped or taken back; empty: it was. */
  deployWhy = '';
  rolloutWhy = '';
  /** The roll-out that this page need not show any more, by when it began. */
  dismissed: number | null = null;

  private target = '';

  constructor(private readonly studio: Studio) {
    // Numbers are those of the server's life.
    studio.connection.renewed.on(() => this.forgetEvents());
  }

  /** Of another fleet nothing is left over. */
  enter(target: string): void {
    if (this.target === target) return;
    if (this.target !== '') {
      this.set({ choice: noChoice, query: '', report: null });
      this.forgetEvents();
    }
    this.target = target;
  }

  private forgetEvents(): void {
    this.events = [];
    this.leftOut = 0;
    this.eventsChanged.emit();
  }

  set(part: Partial<Pick<FleetDesk, 'choice' | 'query' | 'sort' | 'filter' | 'report'>>): void {
    Object.assign(this, part);
    this.changed.emit();
  }

  /** Follows the events of the fleet until the returned function is called. */
  follow(): () => void {
    return this.studio.connection.watch(
      'fleet_events',
      { last: kFleetEventsKept },
      {
        items: (items, leftOut) => {
          const last = this.events.at(-1)?.number ?? -1;
          // What comes was checked against the topic. A connection that was made again begins with those that are known.
          const fresh = (items as unknown as FleetEvent[]).filter(({ number }) => number > last);
          this.events = [...this.events, ...fresh].slice(-kFleetEventsKept);
          this.leftOut += leftOut;
          this.eventsChanged.emit();
        },
      },
      5,
    );
  }

  /** Tells robots what to do; who did not do it is in the report. null: all, which only stop may be for. */
  async order(verb: Verb, robots: readonly string[] | null, words: OrderWords = {}): Promise<void> {
    const report = (progress: Progress) =>
      this.set({ report: { verb, robots: robots?.length ?? 'all', ...progress } });
    report({ is: 'sent' });
    try {
      const answers = await Promise.all(this.send(verb, robots, words));
      report({ is: 'answered', outcomes: answers.flatMap(({ outcomes }) => outcomes) });
    } catch (problem) {
      report({ is: 'failed', why: whyOf(problem) });
    }
  }

  /**
   * The project that is open for these robots, or for all of the fleet, without the unsaved changes of
   * these files. Whether it was taken: not while another file has unsaved changes.
   */
  async deploy(
    robots: readonly string[],
    steps: string,
    without: readonly Path[],
  ): Promise<boolean> {
    const chosen = robots.length === 0 ? {} : { robots: [...robots] };
    const words = { ...chosen, steps: steps.trim(), without: [...without] };
    const due = this.studio.connection.deadline();
    this.deployWhy = await whyNot(
      // What was typed just now is a change that the server does not know yet.
      this.studio.documents.flushAll().then(() => this.studio.send('fleet.deploy', words, due)),
    );
    this.dismissed = null;
    this.changed.emit();
    return this.deployWhy === '';
  }

  async stopRollout(): Promise<void> {
    this.rolloutWhy = await whyNot(this.studio.send('fleet.rollout_stop', {}));
    this.changed.emit();
  }

  async rollBack(): Promise<void> {
    this.rolloutWhy = await whyNot(this.studio.send('fleet.rollback', {}));
    this.changed.emit();
  }

  dismiss(begun: number): void {
    this.dismissed = begun;
    this.changed.emit();
  }

  private send(verb: Verb, robots: readonly string[] | null, words: OrderWords) {
    if (robots === null) return [this.studio.send('fleet.stop', {})];
    return inBatches(robots).map((batch) =>
      verb === 'stop'
        ? this.studio.send('fleet.stop', { robots: batch })
        : this.studio.send('fleet.order', { ...words, verb, robots: batch }),
    );
  }
}

async function whyNot(sent: Promise<unknown>): Promise<string> {
  try {
    await sent;
    return '';
  } catch (problem) {
    return whyOf(problem);
  }
}

export const fleetDesk: (studio: Studio) => FleetDesk = deskFor((studio) => new FleetDesk(studio));
