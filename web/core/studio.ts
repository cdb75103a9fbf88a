// Everything behind the pages, put together: one of these for each page.

import type { CommandName, Commands, Doc } from '../protocol/messages';
import { answers, CommandError, Connection } from './connection';
import { Documents } from './documents';
import { Emitter } from './emitter';
import { Happenings } from './happenings';
import type { Identity } from './identity';
import { Orders } from './orders';
import { Past } from './past';
import { PickList } from './picks';
import { Plotter } from './plotter';
import { Registry } from './registry';
import type { World } from './socket';
import { Stopping } from './stopping';
import { TopicCache } from './topics';
import { createWindowStore, forgetProject, toast, type WindowStore } from './window_state';
import { LiveWords } from './words';
import { Hand } from './world/hand';
import { Ways } from './world/ways';

/** Commands that say which texts they are for. */
type Changing = {
  [C in CommandName]: 'seen' extends keyof Commands[C]['in'] ? C : never;
}[CommandName];

export class Studio {
  readonly connection: Connection;
  readonly stopping: Stopping;
  private readonly orders: Orders;
  readonly topics: TopicCache;
  readonly documents: Documents;
  readonly registry = new Registry();
  readonly window: WindowStore = createWindowStore();
  readonly words: LiveWords;
  readonly happenings: Happenings;
  readonly plotter: Plotter;
  /** Now, or the instant that is looked back at. */
  readonly past: Past;
  /** What this page did by hand in the world of the run. */
  readonly hand: Hand;
  /** Where its robots went. */
  readonly ways: Ways;
  /** The variables of the watch table. */
  readonly watched = new PickList();
  /** Another project is open, and in that one is something that the server does not have. */
  readonly left = new Emitter<{ folder: string; docs: readonly Doc[] }>();
  /** The project was opened while this page was there. */
  wasOpenedHere = false;
  /** Of the project that is looked at; '' if there is none, null until the server has said it. */
  private folder: string | null = null;
  /** What the server calls this page, or did when it was last heard. */
  private number: number | null = null;
  /** It had control before the connection was lost, and nobody has it now: what is typed goes on being typed. */
  private keepsControl = false;
  private wasOpen = false;

  constructor(
    readonly world: World,
    identity: Identity,
    token: string,
    now: () => number,
  ) {
    const { client, nonce, firstId, usedId, renamed } = identity;
    this.connection = new Connection(world, {
      token,
      client,
      nonce,
      firstId,
      usedId,
      renamed,
      hadControl: () => this.hasControl,
      now,
      clock: () => performance.now(),
    });
    this.stopping = new Stopping(this.connection, world);
    this.orders = new Orders(this.connection, this.stopping);
    this.topics = new TopicCache(this.connection, (ms, act) => world.later(ms, act));
    this.documents = new Documents(this.connection, this.topics, {
      later: (ms, act) => world.later(ms, act),
      now,
      page: Math.floor(world.chance() * 2 ** 52).toString(36),
    });
    const timed = {
      frame: (act: () => void) => world.frame(act),
      later: (ms: number, act: () => void) => world.later(ms, act),
      now,
    };
    this.words = new LiveWords(this.connection, timed);
    this.happenings = new Happenings(this.connection, timed);
    this.plotter = new Plotter(this.connection, this.topics, this.happenings, timed);
    this.past = this.makePast();
    this.ways = new Ways((input) => this.send('history.ways', input));
    this.hand = new Hand((command, input) => this.send(command, input));
    this.hand.failed.on((problem) => this.tell(problem));
    this.registry.failed.on((problem) => this.tell(problem));
    this.topics.subscribe('studio', {}, () => {
      if (this.topics.get('studio', {})?.driver !== 0) this.keepsControl = false;
      this.lookAtProject();
      if (this.drives) this.documents.tryAgain();
    });
    this.connection.changed.on((link) => {
      const isOpen = link.state === 'open';
      if (isOpen && !this.wasOpen) this.keepsControl = this.hasControl;
      if (link.state === 'open') this.number = link.number;
      this.wasOpen = isOpen;
    });
  }

  private makePast(): Past {
    const { words } = this;
    const past = new Past(this.connection, this.topics, () => words.ranges());
    past.changed.on(() =>
      words.showThen(past.at === null ? null : (node, address) => past.value(node, address)),
    );
    words.asked.on(() => past.ask());
    past.failed.on((problem) => this.tell(problem));
    this.topics.subscribe('history', {}, () => past.told());
    return past;
  }

  /** Another project, or none: what is known of the one before is forgotten before anyone looks. */
  private lookAtProject(): void {
    const folder = this.topics.get('studio', {})?.project?.folder ?? '';
    if (folder === this.folder) return;
    const before = this.folder;
    this.folder = folder;
    if (before === null) return;
    this.wasOpenedHere = true;
    const unsent = this.documents.leave(before);
    if (unsent.length > 0) this.left.emit({ folder: before, docs: unsent });
    this.past.closeTrace();
    this.happenings.clear();
    this.hand.forget();
    this.ways.forget();
    this.topics.forget(['studio', 'start', 'targets']);
    forgetProject(this.window);
    this.documents.enter(folder);
  }

  /** Makes a new token of those who drive; whoever has the old one is sent away. */
  async renewToken(): Promise<string> {
    const { token } = await this.send('access.renew', {});
    this.connection.token = token;
    return token;
  }

  /** This page may change things. */
  get drives(): boolean {
    return answers(this.connection.link) && this.hasControl;
  }

  /** The same, also while there is no connection: what is typed then is sent when it is back. */
  get mayEdit(): boolean {
    const { state } = this.connection.link;
    if (state !== 'open' && state !== 'lost') return false;
    return this.keepsControl || this.hasControl;
  }

  private get hasControl(): boolean {
    return this.number !== null && this.topics.get('studio', {})?.driver === this.number;
  }

  /** `due`: what inTurn() has told. */
  send<C extends CommandName>(
    command: C,
    input: Commands[C]['in'],
    due?: number,
  ): Promise<Commands[C]['out']> {
    return this.connection.send(command, input, due);
  }

  /**
   * For what changes texts on the server: what was typed goes first, and it is refused if one of the
   * texts is another one by then. With a document: only that one counts.
   */
  async change<C extends Changing>(
    command: C,
    input: Commands[C]['in'],
    doc?: Doc,
  ): Promise<Commands[C]['out']> {
    const seen = await this.documents.seen(doc);
    return this.send(command, { ...input, seen });
  }

  /**
   * For what starts, pauses and steps a robot: sent once `ready` is there, and in the order in which it
   * was asked for. Null, and not sent, if Stop was pressed meanwhile. `due` goes with what is sent: the
   * time since the key press counts, not that since `ready`.
   */
  inTurn<T, R>(
    ready: Promise<T>,
    send: (prepared: T, due: number | undefined) => Promise<R>,
  ): Promise<R | null> {
    return this.orders.ask(ready, send);
  }

  /** The same for a command that needs nothing first. */
  sendInTurn<C extends CommandName>(
    command: C,
    input: Commands[C]['in'],
  ): Promise<Commands[C]['out'] | null> {
    return this.inTurn(Promise.resolve(), (_, due) => this.send(command, input, due));
  }

  /** Sends what nobody waits for; a failure is shown as a toast. */
  order<C extends CommandName>(command: C, input: Commands[C]['in']): void {
    this.connection.send(command, input).catch((problem: unknown) => this.tell(problem));
  }

  /** Leaves the project that is open, if one is, for another; what was typed into it goes along first. */
  async openAnother<C extends 'project.open' | 'project.new' | 'project.make'>(
    command: C,
    input: Commands[C]['in'],
  ): Promise<void> {
    await this.documents.flushAll();
    this.order(command, input);
  }

  /** Shows what went wrong. */
  tell(problem: unknown): void {
    toast(this.window, 'error', problem instanceof Error ? whatOf(problem) : String(problem));
  }
}

function whatOf(problem: Error): string {
  if (!(problem instanceof CommandError)) return problem.message;
  const { what, place } = problem.problem;
  return place ? `${place}: ${what}` : what;
}
