// What a timeline draws, asked from the server: the newest wish only, and not too often while the
// run goes on.

import type { Commands } from '../protocol/messages';
import type { Connection } from './connection';
import { Emitter } from './emitter';
import type { Span } from './ring';
import type { Lanes } from './timeline';
import { whyOf } from './why';

export type LanesWish = Commands['history.lanes']['in'];

/** From one answer to the next question. */
export const kLanesMs = 250;

export class LanesFeed {
  readonly changed = new Emitter<void>();
  lanes: Lanes | null = null;
  /** The seconds that the answer is about. */
  span: Span | null = null;
  /** Why there is no answer. */
  problem: string | null = null;
  private wish: LanesWish | null = null;
  private state = '';
  private asked = '';
  private busy = false;

  constructor(
    private readonly connection: Pick<Connection, 'send'>,
    private readonly later: (milliseconds: number, act: () => void) => () => void,
  ) {}

  /** state: of what goes on within these seconds; another one is another question. */
  want(wish: LanesWish | null, state = ''): void {
    this.wish = wish;
    this.state = state;
    if (!this.busy) void this.ask();
  }

  private async ask(): Promise<void> {
    const { wish } = this;
    const text = `${this.state} ${JSON.stringify(wish)}`;
    if (!wish || text === this.asked) return;
    this.busy = true;
    this.asked = text;
    try {
      this.lanes = await this.connection.send('history.lanes', wish);
      this.span = { from: wish.from, to: wish.to };
      this.problem = null;
    } catch (problem) {
      this.lanes = null;
      this.problem = whyOf(problem);
    }
    this.changed.emit();
    this.later(kLanesMs, () => {
      this.busy = false;
      void this.ask();
    });
  }
}
