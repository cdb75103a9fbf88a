// What a list needs of which only a part is in the page: which rows are seen, and keys.

import {
  useEffect,
  useLayoutEffect,
  useRef,
  useState,
  type KeyboardEvent,
  type RefObject,
} from 'react';

export function useSeen(frame: RefObject<HTMLDivElement | null>, height: number) {
  const [seen, setSeen] = useState({ first: 0, count: 40 });
  useEffect(() => {
    const place = frame.current;
    if (!place) return;
    const look = () => {
      const first = Math.floor(place.scrollTop / height);
      const count = Math.ceil(place.clientHeight / height) + 1;
      setSeen((before) =>
        before.first === first && before.count === count ? before : { first, count },
      );
    };
    look();
    const observer = new ResizeObserver(look);
    observer.observe(place);
    place.addEventListener('scroll', look, { passive: true });
    return () => {
      observer.disconnect();
      place.removeEventListener('scroll', look);
    };
  }, [frame, height]);
  return seen;
}

/** Keeps the rows that are read where they are when new ones come above them. */
export function useAnchor<Row>(
  frame: RefObject<HTMLDivElement | null>,
  rows: readonly Row[] | null,
  keyOf: (row: Row) => string | number,
  height: number,
): void {
  const before = useRef<string | number | null>(null);
  const first = rows?.[0];
  const key = first === undefined ? null : keyOf(first);
  useLayoutEffect(() => {
    const place = frame.current;
    const old = before.current;
    before.current = key;
    if (!place || !rows || old === null || old === key || place.scrollTop < height) return;
    const came = rows.findIndex((row) => keyOf(row) === old);
    if (came > 0) place.scrollBy(0, came * height);
  });
}

export function showRow(frame: HTMLElement | null, index: number, height: number): void {
  if (!frame) return;
  const top = index * height;
  if (top < frame.scrollTop) frame.scrollTop = top;
  else if (top + height > frame.scrollTop + frame.clientHeight)
    frame.scrollTop = top + height - frame.clientHeight;
}

export function nextRow(key: string, index: number, count: number, page: number): number | null {
  const by: Record<string, number> = {
    ArrowDown: 1,
    ArrowUp: -1,
    PageDown: page - 2,
    PageUp: 2 - page,
    Home: -count,
    End: count,
  };
  const step = by[key];
  return step === undefined ? null : Math.max(0, Math.min(count - 1, index + step));
}

export function stepInside(row: HTMLElement, event: KeyboardEvent<HTMLElement>): boolean {
  const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
  if (!by) return false;
  const stops = [row, ...row.querySelectorAll<HTMLElement>('button:not(:disabled), select')];
  stops[stops.indexOf(event.target as HTMLElement) + by]?.focus();
  return true;
}

export function rowOf(target: EventTarget): HTMLElement | null {
  return target instanceof HTMLElement ? target.closest<HTMLElement>('[data-row]') : null;
}

export function isField(target: EventTarget): boolean {
  return target instanceof HTMLElement && target.matches('input, textarea, select');
}
