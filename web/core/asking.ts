// Why something in the run is as it is: what was asked last, and what was answered.

import type { Commands } from '../protocol/messages';
import { deskFor } from './desk';
import { Emitter } from './emitter';
import type { Studio } from './studio';
import { whyOf } from './why';

export type About = Commands['why.ask']['in']['about'];
export type WhyLink = Commands['why.ask']['out']['chain'][number];

export interface Question {
  about: About;
  /** Of the end: ''. */
  name: string;
  /** The instant that is shown; null: now. */
  t: number | null;
  /** Of several with plans, where it is not the one whose plan is shown. */
  robot?: string | undefined;
}

export class Asking {
  readonly changed = new Emitter<void>();
  /** What the panel shows: why something is as it is, or when something was decided. */
  view: 'why' | 'decided' = 'why';
  question: Question | null = null;
  /** What it followed from, the newest first; null until it is answered. */
  chain: readonly WhyLink[] | null = null;
  /** Why it is not answered; '': it is, or will be. */
  trouble = '';

  constructor(
    private readonly send: (input: Commands['why.ask']['in']) => Promise<{ chain: WhyLink[] }>,
  ) {}

  get waits(): boolean {
    return this.question !== null && this.chain === null && this.trouble === '';
  }

  look(view: Asking['view']): void {
    this.view = view;
    this.changed.emit();
  }

  /** The run that it was about is gone: its instants are those of another one. */
  forget(): void {
    this.question = null;
    this.chain = null;
    this.trouble = '';
    this.changed.emit();
  }

  /** The answer to a question before this one counts no more. */
  async ask(question: Question): Promise<void> {
    this.view = 'why';
    this.show(question, null, '');
    const { about, name, t, robot } = question;
    const input: Commands['why.ask']['in'] = { about };
    if (name !== '') input.name = name;
    if (t !== null) input.t = t;
    if (robot !== undefined) input.robot = robot;
    try {
      const { chain } = await this.send(input);
      if (this.question === question) this.show(question, chain, '');
    } catch (problem) {
      if (this.question === question) this.show(question, null, whyOf(problem));
    }
  }

  private show(question: Question, chain: readonly WhyLink[] | null, trouble: string): void {
    this.question = question;
    this.chain = chain;
    this.trouble = trouble;
    this.changed.emit();
  }
}

export const askingOf: (studio: Studio) => Asking = deskFor((studio: Studio) => {
  const asking = new Asking((input) => {
    return studio.send('why.ask', { ...studio.past.asked, ...input });
  });
  studio.connection.renewed.on(() => asking.forget());
  return asking;
});
