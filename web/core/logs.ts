// Log points put into the run that is shown afterwards: what variables held each time that a line of
// a script or an element of the plan was reached. The server runs the recorded run again for each,
// one after the other.

import type { Commands, Doc } from '../protocol/messages';
import { csvOf } from './csv';
import { deskFor } from './desk';
import { Emitter } from './emitter';
import { logLinesOf, type LogLine } from './log_lines';
import { shownTime } from './numbers';
import type { Studio } from './studio';
import { whyOf } from './why';

export const kLogPointsMax = 20;
/** An answer that takes longer is said to be slow. */
export const kSlowMs = 4000;

type Asked = Commands['log.ask']['in'];
export type Logged = Commands['log.ask']['out'];
export type When = NonNullable<Asked['when']>;

export type LogPlace =
  | { is: 'line'; doc: Doc; line: number }
  | { is: 'actor'; doc: Doc; element: string; when: 'enter' | 'leave' }
  | { is: 'supervisor'; doc: Doc; element: string; when: 'raise' };

export type LogPoint = Readonly<{
  /** Also what the server is told, to cancel it. */
  number: number;
  place: LogPlace;
  /** As they were asked last; '': they are still to be typed. */
  values: string;
  /** typed: not asked of this run. */
  state: 'typed' | 'waits' | 'told' | 'refused';
  found: Logged | null;
  trouble: string;
}>;

export interface LogRow {
  key: string;
  t: number;
  point: LogPoint;
  /** The node, where several robots have it. */
  where: string;
  values: readonly { name: string; text: string }[];
}

interface Outside {
  ask(input: Asked): Promise<Logged>;
  cancel(number: number): void;
  later(ms: number, act: () => void): () => void;
}

export class Logs {
  readonly changed = new Emitter<void>();
  points: readonly LogPoint[] = [];
  /** The one whose values are typed next. */
  wanted: number | null = null;
  private run = '';
  private count = 0;
  /** The one that the server is asked just now. */
  asking: number | null = null;
  isSlow = false;
  private endWait = () => {};

  constructor(private readonly outside: Outside) {}

  /** One at that place; the one that is there already is taken. False: there are too many. */
  add(place: LogPlace): boolean {
    const there = this.points.find((one) => samePlace(one.place, place));
    if (!there && this.points.length >= kLogPointsMax) return false;
    this.wanted = there?.number ?? ++this.count;
    if (!there) this.points = [...this.points, fresh(this.wanted, place)];
    this.changed.emit();
    return true;
  }

  ask(number: number, values: string): void {
    this.drop(number);
    this.change(number, { values, state: 'waits', found: null, trouble: '' });
    this.askNext();
  }

  /** Its element is looked at when it begins, or when it ends. */
  move(number: number, when: 'enter' | 'leave'): void {
    const point = this.points.find((one) => one.number === number);
    if (point?.place.is !== 'actor') return;
    this.change(number, { place: { ...point.place, when } });
    if (point.values !== '') this.ask(number, point.values);
  }

  /** It is not waited for any more. */
  cancel(number: number): void {
    this.drop(number);
    this.change(number, { state: 'typed' });
    this.askNext();
  }

  remove(number: number): void {
    this.drop(number);
    this.points = this.points.filter((one) => one.number !== number);
    this.changed.emit();
    this.askNext();
  }

  clear(): void {
    for (const { number } of this.points) this.remove(number);
  }

  /** What was found in another run counts no more. */
  told(run: string): void {
    if (run === this.run) return;
    this.run = run;
    if (this.asking !== null) this.drop(this.asking);
    this.points = this.points.map((one) => ({ ...one, state: 'typed', found: null, trouble: '' }));
    this.changed.emit();
  }

  /** Those at lines of scripts. */
  get lines(): LogLine[] {
    return this.points.flatMap(({ place, values }) =>
      place.is === 'line' ? [{ doc: place.doc, line: place.line, values }] : [],
    );
  }

  /** Of all points, in the order of time. */
  get rows(): LogRow[] {
    const rows = this.points.flatMap((point) =>
      (point.found?.hits ?? []).map(({ t, where, values }, index) => ({
        key: `${point.number}.${index}`,
        t,
        point,
        where,
        values: values.map((text, at) => ({ name: point.found?.names[at] ?? '', text })),
      })),
    );
    return rows.sort((one, other) => one.t - other.t);
  }

  private drop(number: number): void {
    if (this.asking !== number) return;
    this.end();
    this.outside.cancel(number);
  }

  private askNext(): void {
    const next = this.points.find(({ state }) => state === 'waits');
    if (this.asking === null && next) void this.fetch(next);
  }

  /** An answer counts as long as its point waits for just this. */
  private async fetch({ number, place, values }: LogPoint): Promise<void> {
    this.asking = number;
    this.endWait = this.outside.later(kSlowMs, () => {
      this.isSlow = true;
      this.changed.emit();
    });
    const waited = this.points.find((one) => one.number === number);
    let end: Partial<LogPoint>;
    try {
      end = { state: 'told', found: await this.outside.ask(inputOf(number, place, values)) };
    } catch (problem) {
      end = { state: 'refused', trouble: whyOf(problem) };
    }
    const still = this.points.find((one) => one.number === number);
    if (still !== waited) return;
    this.end();
    this.change(number, end);
    this.askNext();
  }

  private end(): void {
    this.asking = null;
    this.isSlow = false;
    this.endWait();
  }

  private change(number: number, to: Partial<LogPoint>): void {
    this.points = this.points.map((one) => (one.number === number ? { ...one, ...to } : one));
    this.changed.emit();
  }
}

const fresh = (number: number, place: LogPlace): LogPoint => ({
  number,
  place,
  values: '',
  state: 'typed',
  found: null,
  trouble: '',
});

function inputOf(number: number, place: LogPlace, values: string): Asked {
  const { doc } = place;
  if (place.is === 'line') return { number, doc, line: place.line, values };
  return { number, doc, element: place.element, when: place.when, values };
}

/** An actor has one, for its beginning or its end. */
function samePlace(one: LogPlace, other: LogPlace): boolean {
  if (one.doc !== other.doc || one.is !== other.is) return false;
  if (one.is === 'line') return other.is === 'line' && one.line === other.line;
  return other.is !== 'line' && one.element === other.element;
}

/** A column for each value that is shown. */
export function logsCsv(rows: readonly LogRow[], placeOf: (row: LogRow) => string): string {
  const names = [...new Set(rows.flatMap(({ values }) => values.map(({ name }) => name)))];
  return csvOf([
    ['t', 'place', ...names],
    ...rows.map((row) => [
      shownTime(row.t),
      placeOf(row),
      ...names.map((name) => row.values.find((one) => one.name === name)?.text),
    ]),
  ]);
}

export const logsOf: (studio: Studio) => Logs = deskFor((studio: Studio) => {
  const logs = new Logs({
    ask: (input) => studio.send('log.ask', input),
    // It is answered by the failure of what it cancels.
    cancel: (number) => void studio.send('log.cancel', { number }).catch(() => {}),
    later: (ms, act) => studio.world.later(ms, act),
  });
  const { topics, connection } = studio;
  const folder = () => topics.get('studio', {})?.project?.folder;
  let project = folder();
  topics.subscribe('studio', {}, () => {
    if (folder() !== project) logs.clear();
    project = folder();
  });
  const told = () => {
    const history = topics.get('history', {});
    if (history) logs.told(`${connection.life} ${history.run}`);
  };
  topics.subscribe('history', {}, told);
  told();
  logs.changed.on(() => logLinesOf(studio).show(logs.lines));
  return logs;
});
