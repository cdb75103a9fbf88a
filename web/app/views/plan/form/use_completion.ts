// Completion in one field: what is offered at the caret, which of it is chosen, and the keys for it.

import { useLayoutEffect, useRef, useState, type KeyboardEvent, type RefObject } from 'react';
import type { FormulaWord } from '../../../../protocol/messages';
import { completed, offersFor, wordAt, type Offer } from '../../../../core/plan/completion';
import type { Variable } from '../../../../core/plan/model';

const kShown = 50;

export interface Completion {
  offers: readonly Offer[];
  /** -1: none yet, the keys belong to the field. */
  chosen: number;
  /** After each change of the text. */
  typed(text: string, caret: number): void;
  /** True: the key was for the list. */
  key(event: KeyboardEvent<HTMLInputElement>): boolean;
  take(offer: Offer): void;
  close(): void;
}

export function useCompletion(
  field: RefObject<HTMLInputElement | null>,
  variables: readonly Variable[],
  words: readonly FormulaWord[],
  write: (text: string) => void,
): Completion {
  const [offers, offer] = useState<readonly Offer[]>([]);
  const [chosen, choose] = useState(-1);
  const caretRef = useCaret(field);
  const show = (text: string, at: number, isAsked: boolean) => {
    const word = wordAt(text, at);
    const typed = word === null ? '' : text.slice(word.from, at);
    const found =
      word && (isAsked || typed !== '') ? offersFor(variables, words, typed, isAsked) : [];
    offer(found.slice(0, kShown));
    choose(isAsked && found.length > 0 ? 0 : -1);
  };
  const close = () => offer([]);
  const take = (one: Offer) => {
    const input = field.current;
    const word = input && wordAt(input.value, input.selectionStart ?? input.value.length);
    if (!input || !word) return;
    const after = completed(input.value, word, one);
    write(after.text);
    caretRef.current = after.caret;
    close();
  };
  const key = (event: KeyboardEvent<HTMLInputElement>): boolean => {
    const { value, selectionStart } = event.currentTarget;
    if (event.key === ' ' && event.ctrlKey) show(value, selectionStart ?? value.length, true);
    else if (offers.length === 0) return false;
    else if (event.key === 'Escape') close();
    else if (event.key === 'ArrowDown') choose((chosen + 1) % offers.length);
    else if (event.key === 'ArrowUp') choose(Math.max(0, chosen - 1));
    else if ((event.key === 'Enter' || event.key === 'Tab') && offers[chosen]) take(offers[chosen]);
    else return false;
    event.preventDefault();
    return true;
  };
  return { offers, chosen, typed: (text, at) => show(text, at, false), key, take, close };
}

/** Where the caret goes once the new text is in the field. */
function useCaret(field: RefObject<HTMLInputElement | null>): RefObject<number | null> {
  const caret = useRef<number | null>(null);
  useLayoutEffect(() => {
    if (caret.current === null) return;
    field.current?.setSelectionRange(caret.current, caret.current);
    caret.current = null;
  });
  return caret;
}
