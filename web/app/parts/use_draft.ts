import { createContext, useContext, useEffect, useRef, useState, type KeyboardEvent } from 'react';
import type { Doc } from '../../protocol/messages';
import { useStudio } from '../hooks';

/** The file that the fields inside change; null: none, as those of breakpoints. */
export const FieldsOf = createContext<Doc | null>(null);

/** What is typed into a field until it counts: Enter and leaving take it, Escape forgets it. */
export interface Draft {
  /** null: nothing is typed that does not count yet. */
  readonly typed: string | null;
  /** What the field shows. */
  readonly shown: string;
  /** What is typed was refused: it stays until it is changed. */
  readonly isRefused: boolean;
  set(text: string | null): void;
  /** False: it is refused. */
  done(): boolean;
  /** True if the key was the draft's own. */
  key(event: KeyboardEvent): boolean;
}

/** `take` gets what was typed, if it is another text than the value; false: it cannot be that. */
export function useDraft(value: string, take: (typed: string) => boolean | void): Draft {
  const [typed, setTyped] = useState<string | null>(null);
  const [isRefused, setRefused] = useState(false);
  const set = (text: string | null) => {
    setTyped(text);
    setRefused(false);
  };
  const done = () => {
    const isTaken = typed === null || typed === value || take(typed) !== false;
    if (isTaken) set(null);
    else setRefused(true);
    return isTaken;
  };
  const key = (event: KeyboardEvent) => {
    if (event.key === 'Enter') done();
    else if (event.key === 'Escape') set(null);
    else return false;
    return true;
  };
  useTyped(typed !== null && typed !== value, done);
  return { typed, shown: typed ?? value, isRefused, set, done, key };
}

/**
 * Save and Run take what is typed before they do their work: a field, or a form of several, with
 * something in it that does not count yet. `take`: false if it is refused.
 */
export function useTyped(isTyped: boolean, take: () => boolean): void {
  const { fields } = useStudio().documents;
  const doc = useContext(FieldsOf);
  const settle = useRef(take);
  useEffect(() => {
    settle.current = take;
  });
  useEffect(
    () => (isTyped ? fields.add({ doc, settle: () => settle.current() }) : undefined),
    [fields, doc, isTyped],
  );
}
