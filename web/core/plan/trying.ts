// A plan tried by hand: what was chosen so far, and what can be chosen next. The server takes the
// whole way again for each choice, so nothing has to be kept there, and the last choice can be
// taken back.

import type { Commands, Doc, TryChoice } from '../../protocol/messages';
import { deskFor } from '../desk';
import { Emitter } from '../emitter';
import type { Studio } from '../studio';
import { whyOf } from '../why';

type Input = Commands['plan.try']['in'];
export type Tried = Commands['plan.try']['out'];
export type Turn = Tried['turns'][number];

/** What can be chosen: a state in which the active actor ends, an event that a supervisor raises. */
export interface Option extends TryChoice {
  is: 'state' | 'event';
}

export class Trying {
  readonly changed = new Emitter<void>();
  doc: Doc | null = null;
  way: readonly TryChoice[] = [];
  answer: Tried | null = null;
  /** Why it cannot be tried; '': it can. */
  trouble = '';
  /** The answer to the last choice has not come yet. */
  waits = false;
  private asked = 0;

  constructor(private readonly send: (input: Input) => Promise<Tried>) {}

  start(doc: Doc): void {
    Object.assign(this, { doc, answer: null, trouble: '' });
    void this.go([]);
  }

  /** By their numbers, from 0: states first, then events. */
  get options(): readonly Option[] {
    const { waits, raises = [] } = this.answer ?? {};
    const states = (waits?.states ?? []).map((outcome): Option => ({
      is: 'state',
      path: waits?.path ?? '',
      element: waits?.actor ?? '',
      outcome,
    }));
    const events = raises.flatMap(({ path, supervisor, events }) =>
      events.map((outcome): Option => ({ is: 'event', path, element: supervisor, outcome })),
    );
    return [...states, ...events];
  }

  async choose({ path, element, outcome }: TryChoice): Promise<void> {
    // What is chosen while an answer is awaited is chosen in a situation that is over.
    if (!this.waits) await this.go([...this.way, { path, element, outcome }]);
  }

  /** As it was after so many choices. */
  async back(count: number): Promise<void> {
    await this.go(this.way.slice(0, Math.max(0, count)));
  }

  /** To the instant at which an actor began. */
  async backTo(turn: Turn): Promise<void> {
    await this.back((this.answer?.taken ?? []).filter((t) => t <= turn.from).length);
  }

  /** Takes the same way again: the plan is another one. */
  async again(): Promise<void> {
    if (this.doc !== null) await this.go(this.way);
  }

  private async go(way: readonly TryChoice[]): Promise<void> {
    const { doc } = this;
    if (doc === null) return;
    const number = ++this.asked;
    this.waits = true;
    this.changed.emit();
    try {
      const answer = await this.send({ doc, way: [...way] });
      if (number !== this.asked) return;
      // What does not fit any more, since the plan was edited, is chosen again.
      this.way = way.slice(0, way.length - answer.left);
      this.answer = answer;
      this.trouble = '';
    } catch (problem) {
      if (number !== this.asked) return;
      this.trouble = whyOf(problem);
    }
    this.waits = false;
    this.changed.emit();
  }

  leave(): void {
    ++this.asked;
    Object.assign(this, { doc: null, way: [], answer: null, trouble: '', waits: false });
    this.changed.emit();
  }
}

export const tryingOf: (studio: Studio) => Trying = deskFor(
  (studio: Studio) => new Trying((input) => studio.send('plan.try', input)),
);
