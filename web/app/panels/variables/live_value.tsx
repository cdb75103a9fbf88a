import { useEffect, useEffectEvent, useRef, type RefObject } from 'react';
import type { NodeId, Variable } from '../../../protocol/messages';
import { shownWord, type NumberForm } from '../../../core/numbers';
import { barsOf } from '../../../core/variable_rows';
import type { Seen } from '../../../core/words';
import { useStudio } from '../../hooks';
import { text } from '../../text';

export interface Place {
  node: NodeId;
  variable: Variable;
  first: number;
  count: number;
}

/** A folded array of at most so many words shows them; a longer one shows bars. */
const kValuesShown = 3;
const kColumns = 40;

/** Calls show with the words of a place, each time they change, without rendering anything. */
function useWords(place: Place, show: (seen: Seen) => void): void {
  const { words } = useStudio();
  const { node, first, count } = place;
  const { address, size } = place.variable;
  const told = useEffectEvent(show);
  useEffect(
    () => words.look({ node, address, size, first, count }, (seen) => told(seen)),
    [words, node, address, size, first, count],
  );
}

/** A value that is written into the page as it comes; its row is marked when it has changed. */
export function LiveValue({
  place,
  form,
  row,
}: {
  place: Place;
  form: NumberForm;
  row: RefObject<HTMLElement | null>;
}) {
  const value = useRef<HTMLSpanElement>(null);
  const before = useRef<HTMLSpanElement>(null);
  const bars = useRef<SVGPathElement>(null);
  const last = useRef<Seen | null>(null);
  const isLong = place.count > kValuesShown;
  const show = (seen: Seen) => {
    last.current = seen;
    const known = !seen.past || seen.values.some((one) => one !== undefined);
    if (!isLong) write(value.current, known ? valueText(seen.values, form) : text.past.notRecorded);
    const changed = seen.changed.some(Boolean);
    if (row.current) row.current.toggleAttribute('data-changed', changed);
    row.current?.toggleAttribute('data-past', seen.past === true);
    const old = seen.past === true || (seen.before.some((one) => one !== undefined) && changed);
    write(before.current, old && seen.values.length === 1 ? valueText(seen.before, form) : '');
    bars.current?.setAttribute('d', barsPath(seen.values));
  };
  useWords(place, show);
  const showAgain = useEffectEvent(() => {
    if (last.current) show(last.current);
  });
  // New words come by themselves.
  useEffect(() => showAgain(), [form]);
  return (
    <>
      {isLong ? (
        <svg className="bars bars--long" viewBox="0 0 64 16" preserveAspectRatio="none" aria-hidden>
          <path ref={bars} />
        </svg>
      ) : null}
      <span className="value__before num" ref={before} />
      {isLong ? null : (
        <span
          className={place.count > 1 ? 'value__now value__now--list num' : 'value__now num'}
          ref={value}
        />
      )}
    </>
  );
}

/** An element of an unfolded array as one bar, beside its value. */
export function LiveBar({ place }: { place: Place }) {
  const bar = useRef<SVGRectElement>(null);
  useWords({ ...place, first: place.variable.address, count: place.variable.size }, (seen) => {
    const all = barsOf(seen.values, seen.values.length)[place.first - place.variable.address];
    if (!all) return;
    // Lying down: what is upwards in the picture of the array goes to the right here.
    bar.current?.setAttribute('x', String((1 - all.to) * 64));
    bar.current?.setAttribute('width', String(Math.max(0.5, (all.to - all.from) * 64)));
  });
  return (
    <svg className="bars" viewBox="0 0 64 16" preserveAspectRatio="none" aria-hidden>
      <rect ref={bar} y="4" height="8" />
    </svg>
  );
}

function valueText(values: readonly (number | undefined)[], form: NumberForm): string {
  return values.map((value) => shownWord(value, form)).join(' ');
}

function barsPath(values: readonly (number | undefined)[]): string {
  const bars = barsOf(values, kColumns);
  const width = 64 / bars.length;
  return bars
    .map(({ from, to }, index) => {
      const height = Math.max(0.8, (to - from) * 16);
      const top = Math.min(from * 16, 16 - height);
      return `M${(index * width).toFixed(2)} ${top.toFixed(2)}h${(width * 0.8).toFixed(2)}v${height.toFixed(2)}h-${(width * 0.8).toFixed(2)}z`;
    })
    .join('');
}

function write(element: HTMLElement | null, what: string): void {
  if (element && element.textContent !== what) element.textContent = what;
}
