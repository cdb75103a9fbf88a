// Which tip is shown: that of the element on which the pointer rests, that a finger holds, or that has the
// keyboard's focus.

import { useEffect, useState } from 'react';
import type { World } from '../../core/socket';
import { useStudio } from '../hooks';

export const kTipId = 'tip';
const kRestMs = 400;
/** A finger that stays so long does not tap. */
const kHoldMs = 500;

export interface Tip {
  target: HTMLElement;
  label: string;
}

export function useTip(): Tip | null {
  const { world } = useStudio();
  const [tip, show] = useState<Tip | null>(null);
  useEffect(() => follow(world, show), [world]);
  useEffect(() => {
    // An icon whose name is the tip has said it already.
    if (!tip || tip.target.getAttribute('aria-label') === tip.label) return;
    tip.target.setAttribute('aria-describedby', kTipId);
    return () => tip.target.removeAttribute('aria-describedby');
  }, [tip]);
  return tip;
}

function follow(world: World, show: (tip: Tip | null) => void): () => void {
  let target: HTMLElement | null = null;
  let cancel = () => {};
  /** A finger has asked what this is; until the next one comes, its tip stays. */
  let asked: HTMLElement | null = null;
  const aim = (at: HTMLElement | null) => {
    if (at === target) return;
    cancel();
    target = at;
    show(null);
    if (at) cancel = world.later(kRestMs, () => show(tipOn(at)));
  };
  const hide = () => {
    if (asked === null) aim(null);
  };
  const rests = ({ target: at, pointerType }: PointerEvent) =>
    pointerType === 'touch' ? hide() : aim(withTip(at));
  // Out of the window; into another element is that one's "pointerover".
  const left = ({ relatedTarget }: PointerEvent) => relatedTarget === null && hide();
  const focused = ({ target: at }: FocusEvent) => {
    const found = withTip(at);
    if (found?.matches(':focus-visible')) aim(found);
  };
  const forget = () => {
    asked = null;
    aim(null);
  };
  const ask = (at: HTMLElement) => {
    asked = target = at;
    show(tipOn(at));
  };
  const down = ({ target: at, pointerType }: PointerEvent) => {
    cancel(); // of another finger
    forget();
    const found = pointerType === 'touch' ? withTip(at) : null;
    if (found) cancel = world.later(kHoldMs, () => ask(found));
  };
  const lifted = () => {
    if (asked === null) cancel();
  };
  /** Who asked what a button is has not pressed it. */
  const clicked = (event: MouseEvent) => {
    if (event.target instanceof Node && asked?.contains(event.target)) event.stopPropagation();
  };
  const listened = new AbortController();
  const options = { capture: true, passive: true, signal: listened.signal };
  document.addEventListener('pointerover', rests, options);
  document.addEventListener('pointerout', left, options);
  document.addEventListener('focusin', focused, options);
  document.addEventListener('pointerdown', down, options);
  document.addEventListener('click', clicked, options);
  for (const end of ['pointerup', 'pointercancel'] as const)
    document.addEventListener(end, lifted, options);
  document.addEventListener('keydown', forget, options);
  for (const end of ['focusout', 'wheel'] as const) document.addEventListener(end, hide, options);
  return () => {
    cancel();
    listened.abort();
  };
}

function withTip(at: EventTarget | null): HTMLElement | null {
  return at instanceof Element ? at.closest<HTMLElement>('[data-tip]') : null;
}

function tipOn(target: HTMLElement): Tip | null {
  const label = target.dataset['tip'];
  return label && target.isConnected ? { target, label } : null;
}
