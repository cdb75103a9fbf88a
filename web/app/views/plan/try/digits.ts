// Digits choose how the active actor of a plan that is tried ends.

import type { Trying } from '../../../../core/plan/trying';

/** 1 to 9, also where the row of digits types others without Shift (French: &, é, "). */
export function digitOf({ key, code }: Pick<KeyboardEvent, 'key' | 'code'>): number | null {
  const typed = /^[1-9]$/.exec(key)?.[0] ?? /^Digit([1-9])$/.exec(code)?.[1];
  return typed === undefined ? null : Number(typed);
}

/**
 * What shows a try is loaded with the first one: until it has the keyboard, digits are heard here. Whoever
 * goes elsewhere, by the pointer or another key, types there.
 */
export function hearDigits(trying: Trying): void {
  const over = new AbortController();
  const end = () => over.abort();
  const hear = (event: KeyboardEvent) => {
    const { ctrlKey, altKey, metaKey } = event;
    const digit = ctrlKey || altKey || metaKey ? null : digitOf(event);
    if (digit === null || trying.doc === null) return end();
    event.preventDefault();
    event.stopPropagation();
    void trying.press(digit);
  };
  const how = { capture: true, signal: over.signal };
  document.addEventListener('keydown', hear, how);
  document.addEventListener('pointerdown', end, how);
  document.addEventListener(
    'focusin',
    ({ target }) => target instanceof Element && target.closest('.ptry') && end(),
    how,
  );
}
