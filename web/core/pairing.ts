// Two recorded runs side by side: which, where they are aligned, what came of it, and the instant
// that is shown of both. Instants count from where they are aligned.

import type { Commands, ComparedRun, ComparedWay, Path } from '../protocol/messages';
import { deskFor } from './desk';
import { Emitter } from './emitter';
import type { Studio } from './studio';
import { whyOf } from './why';

export type Compared = Commands['runs.compare']['out'];
export type Align = Commands['runs.compare']['in']['align'];

export interface PairWish {
  /** null: the run that is shown. */
  a: Path | null;
  b: Path | null;
  align: Align;
  /** Of the actor or the event. */
  name: string;
}

export class Pairing {
  readonly changed = new Emitter<void>();
  wish: PairWish = { a: null, b: null, align: 'start', name: '' };
  found: Compared | null = null;
  /** What was asked last. */
  asked: PairWish | null = null;
  trouble = '';
  t = 0;

  constructor(
    private readonly send: (input: Commands['runs.compare']['in']) => Promise<Compared>,
  ) {}

  get waits(): boolean {
    return this.asked !== null && this.found === null && this.trouble === '';
  }

  choose(part: Partial<PairWish>): void {
    this.wish = { ...this.wish, ...part };
    this.changed.emit();
  }

  /** The answer to a question before this one counts no more. */
  async ask(): Promise<void> {
    const asked = (this.asked = { ...this.wish });
    this.show(null, '');
    const { a, b, align, name } = asked;
    const input: Commands['runs.compare']['in'] = { align };
    if (a !== null) input.a = a;
    if (b !== null) input.b = b;
    if (align !== 'start') input.name = name.trim();
    try {
      const found = await this.send(input);
      if (this.asked !== asked) return;
      this.t = found.lanes[0]?.t ?? 0;
      this.show(found, '');
    } catch (problem) {
      if (this.asked === asked) this.show(null, whyOf(problem));
    }
  }

  look(t: number): void {
    const { from, to } = spanOf(this.found);
    this.t = Math.min(Math.max(t, from), to);
    this.changed.emit();
  }

  /** Another run has begun: the one that was shown is a recording like others from now on. */
  toldOfRun(): void {
    const { asked, found } = this;
    if (!asked || (asked.a !== null && asked.b !== null)) return;
    if (!found) return this.forget();
    this.asked = { ...asked, a: asked.a ?? found.a.path, b: asked.b ?? found.b.path };
    this.wish = { ...this.wish, a: this.asked.a, b: this.asked.b };
    this.changed.emit();
  }

  forget(): void {
    this.asked = null;
    this.show(null, '');
  }

  private show(found: Compared | null, trouble: string): void {
    this.found = found;
    this.trouble = trouble;
    this.changed.emit();
  }
}

/** What both cover together. */
export function spanOf(found: Compared | null): { from: number; to: number } {
  if (!found) return { from: 0, to: 0 };
  const { a, b } = found;
  return {
    from: Math.min(-a.start, -b.start),
    to: Math.max(a.end - a.start, b.end - b.start),
  };
}

/** Where a robot was at an instant of its run: x, y, angle; null: nowhere yet. */
export function placeAt({ points }: ComparedWay, t: number): [number, number, number] | null {
  let low = 0;
  let high = points.length / 4;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((points[middle * 4] ?? 0) <= t + 1e-9) low = middle + 1;
    else high = middle;
  }
  const at = (low - 1) * 4;
  if (at < 0) return null;
  return [points[at + 1] ?? 0, points[at + 2] ?? 0, points[at + 3] ?? 0];
}

/** Actors and events of both, by which they can be aligned. */
export function namesIn(found: Compared | null, align: Align): string[] {
  if (!found || align === 'start') return [];
  const of = ({ actors, events }: ComparedRun) => (align === 'actor' ? actors : events);
  const names = [found.a, found.b].map((run) => new Set(of(run).map(({ name }) => name)));
  return [...(names[0] ?? [])].filter((name) => names[1]?.has(name)).sort();
}

export const pairingOf: (studio: Studio) => Pairing = deskFor((studio: Studio) => {
  const pairing = new Pairing((input) => studio.send('runs.compare', input));
  const { topics, connection } = studio;
  const runNow = () => `${connection.life} ${topics.get('history', {})?.run ?? ''}`;
  const folderNow = () => topics.get('studio', {})?.project?.folder;
  let run = runNow();
  let folder = folderNow();
  topics.subscribe('history', {}, () => {
    if (runNow() !== run) pairing.toldOfRun();
    run = runNow();
  });
  topics.subscribe('studio', {}, () => {
    if (folderNow() !== folder) {
      pairing.choose({ a: null, b: null });
      pairing.forget();
    }
    folder = folderNow();
  });
  return pairing;
});
