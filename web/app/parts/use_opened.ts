// Menus and popovers: who has the keyboard when one closes, and what a command's key does while one is open.

import { useLayoutEffect, useRef, useState, type KeyboardEvent } from 'react';

/** Where there is room neither below nor above the button, it lies over the button. */
export const kStaysInWindow = { flip: true, shift: { padding: 4, crossAxis: true } };

export interface Opened {
  opened: boolean;
  onChange(opened: boolean): void;
  /** For a menu: keys that are a command's close it first. */
  onKeyDown(event: KeyboardEvent): void;
}

/**
 * Open or not, by itself or as `given` says. When it closes, what had the focus before has it again, unless
 * what was chosen gave the focus to something else, such as the field for a new file's name.
 */
export function useOpened(given: {
  opened?: boolean | undefined;
  onChange?: ((opened: boolean) => void) | undefined;
}): Opened {
  const [own, setOwn] = useState(false);
  const before = useRef<Element | null>(null);
  const opened = given.opened ?? own;
  // The children's focus comes later, in effects and timers: what has it now had it before.
  useLayoutEffect(() => {
    if (!opened) return;
    const { activeElement } = document;
    before.current = activeElement;
    return () => {
      if (isLost()) focus(activeElement);
    };
  }, [opened]);
  const onChange = (next: boolean) => {
    setOwn(next);
    given.onChange?.(next);
  };
  const onKeyDown = (event: KeyboardEvent) => {
    if (!isCommand(event)) return;
    focus(before.current);
    onChange(false);
  };
  return { opened, onChange, onKeyDown };
}

/** The focus was in something that is no longer there, or is about to go. */
function isLost(): boolean {
  const { activeElement } = document;
  return (
    activeElement === null ||
    activeElement === document.body ||
    activeElement.closest('.menu') !== null
  );
}

function focus(element: Element | null): void {
  if (element instanceof HTMLElement) element.focus({ preventScroll: true });
}

/** Such keys mean the window; the rest moves about in the menu. */
function isCommand({ key, ctrlKey, metaKey }: KeyboardEvent): boolean {
  return /^F\d+$/.test(key) || ((ctrlKey || metaKey) && [...key].length === 1);
}
