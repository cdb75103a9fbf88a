// Samples of one curve: the newest ones, in the order of their times.

/** At 20 Hz half an hour. */
export const kSamplesMax = 36_000;

export class Ring {
  private readonly times: Float64Array;
  private readonly numbers: Float64Array;
  private start = 0;
  length = 0;

  constructor(readonly capacity = kSamplesMax) {
    this.times = new Float64Array(capacity);
    this.numbers = new Float64Array(capacity);
  }

  /** A sample that is not newer than the last one came before, and is left out. */
  push(time: number, value: number): boolean {
    if (this.length > 0 && time <= this.time(this.length - 1)) return false;
    const at = (this.start + this.length) % this.capacity;
    this.times[at] = time;
    this.numbers[at] = value;
    if (this.length < this.capacity) this.length++;
    else this.start = (this.start + 1) % this.capacity;
    return true;
  }

  time(index: number): number {
    return this.times[(this.start + index) % this.capacity] ?? NaN;
  }

  value(index: number): number {
    return this.numbers[(this.start + index) % this.capacity] ?? NaN;
  }

  clear(): void {
    this.start = 0;
    this.length = 0;
  }

  /** The first index whose time is not before this one. */
  from(time: number): number {
    let low = 0;
    let high = this.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.time(middle) < time) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** The first index whose time is after this one. */
  after(time: number): number {
    const at = this.from(time);
    return at < this.length && this.time(at) === time ? at + 1 : at;
  }

  /** What holds at a time: the last sample that is not after it. */
  at(time: number): number | undefined {
    const here = this.after(time) - 1;
    return here < 0 ? undefined : this.value(here);
  }
}

export interface Span {
  from: number;
  to: number;
}

/** Times that all curves share, and what each curve is at them; null where it says nothing. */
export interface Aligned {
  times: number[];
  values: (number | null)[][];
}

/**
 * Samples within a span, one row for each time. With more than `most` times each column of the span
 * keeps the lowest and the highest value of a curve, in their order, so that no peak is lost.
 */
export function align(rings: readonly Ring[], span: Span, most: number): Aligned {
  const parts = rings.map((ring) => ({
    ring,
    // One before the span, so that a line comes in from the left.
    first: Math.max(0, ring.from(span.from) - 1),
    end: ring.after(span.to),
  }));
  const all = parts.reduce((sum, { first, end }) => sum + Math.max(0, end - first), 0);
  return all <= most ? exact(parts) : columns(parts, span, Math.max(1, Math.floor(most / 2)));
}

interface Part {
  ring: Ring;
  first: number;
  end: number;
}

function exact(parts: readonly Part[]): Aligned {
  const all = new Set<number>();
  for (const { ring, first, end } of parts)
    for (let index = first; index < end; index++) all.add(ring.time(index));
  const times = [...all].sort((a, b) => a - b);
  const place = new Map(times.map((time, index) => [time, index]));
  const values = parts.map(({ ring, first, end }) => {
    const column = new Array<number | null>(times.length).fill(null);
    for (let index = first; index < end; index++)
      column[place.get(ring.time(index)) ?? 0] = ring.value(index);
    return column;
  });
  return { times, values };
}

function columns(parts: readonly Part[], span: Span, count: number): Aligned {
  const width = (span.to - span.from) / count;
  const times: number[] = [];
  for (let column = 0; column < count; column++)
    times.push(span.from + column * width, span.from + (column + 0.5) * width);
  return { times, values: parts.map((part) => extremes(part, span.from, width, count)) };
}

function extremes({ ring, first, end }: Part, from: number, width: number, count: number) {
  const out = new Array<number | null>(count * 2).fill(null);
  for (let index = first; index < end; index++) {
    const column = Math.floor((ring.time(index) - from) / width);
    const at = Math.min(Math.max(column, 0), count - 1) * 2;
    const value = ring.value(index);
    const [one, two] = [out[at] ?? null, out[at + 1] ?? null];
    if (one === null) out[at] = value;
    else if (two === null) out[at + 1] = value;
    // Both are there: the pair stays lowest and highest, the later one of the two behind.
    else if (value > Math.max(one, two)) [out[at], out[at + 1]] = [Math.min(one, two), value];
    else if (value < Math.min(one, two)) [out[at], out[at + 1]] = [Math.max(one, two), value];
  }
  return out;
}
