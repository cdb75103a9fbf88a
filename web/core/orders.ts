// What starts, pauses and steps a robot is sent in the order in which it was asked for, although some
// of it waits first, for texts to be sent and checked. None of it outlives a Stop or the connection:
// nobody expects a robot to start after Stop was pressed, or minutes later. The deadline of a command
// is that of the key press, however long it waited here.

import { answers, type Connection } from './connection';
import type { Stopping } from './stopping';

export class Orders {
  private round = new Round();
  private before: Promise<unknown> = Promise.resolve();

  constructor(
    private readonly connection: Connection,
    stopping: Stopping,
  ) {
    stopping.pressed.on(() => this.drop(''));
    // What this page has sent by then carries the Stops that it knew of: the server judges that.
    connection.stopped.on(() => this.drop('Not done: somebody else pressed Stop meanwhile.'));
    connection.changed.on((link) => {
      if (!answers(link)) this.drop('Not sent: the connection to the server was lost.');
    });
  }

  /**
   * Sends once what was asked for before has been sent and `ready` is there, with the deadline of now;
   * gives what `send` gives, or null if Stop was pressed meanwhile. Throws if somebody else pressed it
   * or the connection was lost meanwhile, and what `ready` and `send` throw.
   */
  async ask<T, R>(
    ready: Promise<T>,
    send: (prepared: T, due: number | undefined) => Promise<R>,
  ): Promise<R | null> {
    const due = this.connection.deadline();
    const sent = this.sendInTurn(this.round, this.before, ready, (prepared) => send(prepared, due));
    this.before = Promise.allSettled([this.before, sent]);
    return (await sent).answer;
  }

  /** The answer in an object: who comes next waits for the sending and not for the answer. */
  private async sendInTurn<T, R>(
    round: Round,
    before: Promise<unknown>,
    ready: Promise<T>,
    send: (prepared: T) => Promise<R>,
  ): Promise<{ answer: Promise<R> | null }> {
    const turn = await Promise.race([
      round.dropped,
      Promise.all([ready, before]).then(([prepared]) => ({ prepared })),
    ]);
    if (typeof turn !== 'string') return { answer: send(turn.prepared) };
    if (turn !== '') throw new Error(turn);
    return { answer: null };
  }

  private drop(why: string): void {
    this.round.drop(why);
    this.round = new Round();
    this.before = Promise.resolve();
  }
}

/** What was asked for since the last Stop: what of it has not been sent is dropped together. */
class Round {
  /** Why; '' if everybody knows. */
  readonly dropped: Promise<string>;
  drop: (why: string) => void = () => {};

  constructor() {
    this.dropped = new Promise((done) => (this.drop = done));
  }
}
