// Whether the plan that runs could take over what is drawn, asked now and then while both change.

import type { Commands } from '../../protocol/messages';
import { Emitter } from '../emitter';

export type ChangeAnswer = Commands['plan.check_change']['out'];

/** Between two questions. */
export const kAskEveryMs = 300;

/** Asks at once, and again after look(); never twice at a time. */
export class ChangeQuestion {
  readonly changed = new Emitter<void>();
  answer: ChangeAnswer | null = null;
  private busy = false;
  private again = false;
  private over = false;
  private cancel = () => {};

  constructor(
    private readonly ask: () => Promise<ChangeAnswer>,
    private readonly later: (milliseconds: number, act: () => void) => () => void,
  ) {}

  /** Something has changed that the answer may depend on. */
  look(): void {
    if (this.over) return;
    if (this.busy) {
      this.again = true;
      return;
    }
    this.busy = true;
    this.again = false;
    this.ask().then(
      (answer) => this.take(answer),
      // The asker is told otherwise that the server is gone.
      () => this.take(null),
    );
  }

  end(): void {
    this.over = true;
    this.cancel();
  }

  private take(answer: ChangeAnswer | null): void {
    if (this.over) return;
    this.answer = answer;
    this.changed.emit();
    this.cancel = this.later(kAskEveryMs, () => {
      this.busy = false;
      if (this.again) this.look();
    });
  }
}
