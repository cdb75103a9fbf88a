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
export type Output = NonNullable<Tried['waits']>['outputs'][number];

/** More numbers than these are not pressed ahead of an answer. */
const kEarlyMax = 16;

/** What can be chosen: a state in which the active actor ends, an event that a supervisor raises. */
export interface Option extends TryChoice {
  is: 'state' | 'event';
}

export class Trying {
  readonly changed = new Emitter<void>();
  /** Something was chosen in the drawing. */
  readonly clicked = new Emitter<void>();
  doc: Doc | null = null;
  way: readonly TryChoice[] = [];
  answer: Tried | null = null;
  /** Why it cannot be tried; '': it can. */
  trouble = '';
  /** The answer to the last choice has not come yet. */
  waits = false;
  /** Numbers that were pressed before that answer came: they are for what it offers. */
  private early: readonly number[] = [];
  /** What was typed for outputs of the active actor, by name. */
  typed: Readonly<Record<string, string>> = {};
  private asked = 0;
  /** Where it gave way to what is shown in its place. */
  private left: { doc: Doc; way: readonly TryChoice[] } | null = null;

  constructor(private readonly send: (input: Input) => Promise<Tried>) {}

  start(doc: Doc): void {
    const way = this.left?.doc === doc ? this.left.way : [];
    this.left = null;
    Object.assign(this, { doc, answer: null, trouble: '' });
    void this.go(way);
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

  /** That can be chosen with the state of the active actor. */
  get outputs(): readonly Output[] {
    return (this.answer?.waits?.outputs ?? []).filter(({ type }) => type !== 'object');
  }

  type(output: Output, text: string): void {
    this.typed = { ...this.typed, [output.name]: text };
    this.changed.emit();
  }

  /** What was typed for an output is none of its type. */
  isWrong(output: Output): boolean {
    const text = this.typed[output.name] ?? '';
    return text !== '' && valueOf(output, text) === undefined;
  }

  /** Chooses an option by its number, from 1. While an answer is awaited it is one of that answer's. */
  async press(number: number): Promise<void> {
    if (this.waits) {
      this.early = [...this.early, number].slice(0, kEarlyMax);
      return;
    }
    const option = this.options[number - 1];
    if (option) await this.choose(option);
    else this.early = [];
  }

  /** Nothing while an output is wrong. */
  async choose({ path, element, outcome, is }: TryChoice & { is?: Option['is'] }): Promise<void> {
    // What is chosen while an answer is awaited is chosen in a situation that is over.
    if (this.waits) return;
    const choice: TryChoice = { path, element, outcome };
    if (is === 'state') {
      if (this.outputs.some((one) => this.isWrong(one))) return;
      const out = this.outputs.flatMap((one) => {
        const value = valueOf(one, this.typed[one.name] ?? '');
        return value === undefined ? [] : { name: one.name, value };
      });
      if (out.length > 0) choice.out = out;
    }
    await this.go([...this.way, choice]);
  }

  /** As it was after so many choices. */
  async back(count: number): Promise<void> {
    this.early = [];
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
      this.typed = {};
    } catch (problem) {
      if (number !== this.asked) return;
      this.trouble = sentenceOf(whyOf(problem));
      this.early = [];
    }
    this.waits = false;
    this.changed.emit();
    const [next, ...rest] = this.early;
    this.early = rest;
    if (next !== undefined) await this.press(next);
  }

  /** A run that begins, or the past, is shown in its place; the way is there when it is tried again. */
  giveWay(): void {
    const { doc, way } = this;
    if (doc === null) return;
    this.leave();
    this.left = { doc, way };
  }

  leave(): void {
    ++this.asked;
    this.early = [];
    const nothing = { doc: null, way: [], answer: null, trouble: '', waits: false, typed: {} };
    Object.assign(this, nothing);
    this.changed.emit();
  }
}

/** undefined: it is none of that type. */
function valueOf({ type }: Output, typed: string): string | number | boolean | undefined {
  const text = typed.trim();
  if (type === 'string') return typed === '' ? undefined : typed;
  if (text === '') return undefined;
  const isBool = text === 'true' || text === 'false';
  const number = Number(text);
  if (type === 'bool') return isBool ? text === 'true' : undefined;
  if (type === 'int') return Number.isSafeInteger(number) ? number : undefined;
  if (type === 'float') return Number.isFinite(number) ? number : undefined;
  if (isBool) return text === 'true';
  return Number.isFinite(number) ? number : typed;
}

export const tryingOf: (studio: Studio) => Trying = deskFor((studio: Studio) => {
  const trying = new Trying((input) => studio.send('plan.try', input));
  const { past, topics } = studio;
  const runs = () => studio.drives && topics.get('plan', {})?.state === 'running';
  const isPast = () => past.at !== null;
  topics.subscribe(
    'plan',
    {},
    whenBegins(runs, () => trying.giveWay()),
  );
  past.changed.on(whenBegins(isPast, () => trying.giveWay()));
  return trying;
});

function whenBegins(holds: () => boolean, act: () => void): () => void {
  let held = holds();
  return () => {
    const holding = holds();
    if (holding && !held) act();
    held = holding;
  };
}

/** As a terminal has it, "/home/me/P.plan.json:12:3: error: …", without the folder and the word. */
function sentenceOf(why: string): string {
  return why.replace(/^\S*\/(?=[^/\s]+:\d+:\d+: )/, '').replace(/^(\S+:\d+:\d+: )error: /, '$1');
}
