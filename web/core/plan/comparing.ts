// A plan compared with another version of it: what differs, and which difference is looked at.

import type { Commands, Doc, Json, PlanDifference } from '../../protocol/messages';
import { deskFor } from '../desk';
import { Emitter } from '../emitter';
import type { Studio } from '../studio';
import { whyOf } from '../why';
import { isPlace } from './differences';

type Input = Commands['plan.differences']['in'];
type Output = Commands['plan.differences']['out'];

/** The other version; name: how it is called on screen. */
export interface Other {
  against: Input['against'];
  /** Of `then`. */
  t?: number;
  revision?: string;
  file?: Doc;
  name: string;
}

export interface Compared {
  /** The other version as a file. */
  before: Json;
  /** Without those of places. */
  differences: readonly PlanDifference[];
  places: number;
}

export class Comparing {
  readonly changed = new Emitter<void>();
  /** The document whose menu of versions is open. */
  menu: Doc | null = null;
  doc: Doc | null = null;
  other: Other | null = null;
  answer: Compared | null = null;
  /** Why there is no answer; '': there is one, or will be. */
  trouble = '';
  /** The difference that is looked at; null: none yet. */
  at: number | null = null;

  constructor(private readonly send: (input: Input) => Promise<Output>) {}

  open(doc: Doc | null): void {
    this.menu = doc;
    this.changed.emit();
  }

  /** Shows what differs; the answer to a question before this one counts no more. */
  compare(doc: Doc, other: Other): void {
    Object.assign(this, { doc, other, answer: null, trouble: '', at: null, menu: null });
    this.changed.emit();
    void this.ask();
  }

  /** Asks again: the text, or the other version, is another one. */
  async ask(): Promise<void> {
    const { doc, other } = this;
    if (doc === null || other === null) return;
    const { against, t, revision, file } = other;
    const input: Input = { doc, against };
    if (t !== undefined) input.t = t;
    if (revision !== undefined) input.revision = revision;
    if (file !== undefined) input.file = file;
    const isAsked = () => this.doc === doc && this.other === other;
    try {
      const answer = await this.send(input);
      if (isAsked()) this.take(answer);
    } catch (problem) {
      if (!isAsked()) return;
      this.answer = null;
      this.trouble = whyOf(problem);
      this.changed.emit();
    }
  }

  private take({ before, differences }: Output): void {
    const shown = differences.filter((one) => !isPlace(one));
    this.answer = {
      before: JSON.parse(before) as Json,
      differences: shown,
      places: differences.length - shown.length,
    };
    this.trouble = '';
    if (this.at !== null) this.at = shown.length === 0 ? null : Math.min(this.at, shown.length - 1);
    this.changed.emit();
  }

  leave(): void {
    Object.assign(this, { doc: null, other: null, answer: null, trouble: '', at: null });
    this.changed.emit();
  }

  get current(): PlanDifference | undefined {
    return this.at === null ? undefined : this.answer?.differences[this.at];
  }

  look(at: number): void {
    this.at = at;
    this.changed.emit();
  }

  /** From difference to difference, and round. */
  step(by: 1 | -1): void {
    const count = this.answer?.differences.length ?? 0;
    if (count === 0) return;
    const from = this.at ?? (by === 1 ? -1 : count);
    this.look((from + by + count) % count);
  }
}

export const comparingOf: (studio: Studio) => Comparing = deskFor(
  (studio: Studio) => new Comparing((input) => studio.send('plan.differences', input)),
);
