import { useState, type KeyboardEvent } from 'react';

/** What is typed into a field until it counts: Enter and leaving take it, Escape forgets it. */
export interface Draft {
  /** null: nothing is typed that does not count yet. */
  readonly typed: string | null;
  /** What the field shows. */
  readonly shown: string;
  set(text: string | null): void;
  done(): void;
  /** True if the key was the draft's own. */
  key(event: KeyboardEvent): boolean;
}

/** `take` gets what was typed, if it is another text than the value. */
export function useDraft(value: string, take: (typed: string) => void): Draft {
  const [typed, set] = useState<string | null>(null);
  const done = () => {
    if (typed !== null && typed !== value) take(typed);
    set(null);
  };
  const key = (event: KeyboardEvent) => {
    if (event.key === 'Enter') done();
    else if (event.key === 'Escape') set(null);
    else return false;
    return true;
  };
  return { typed, shown: typed ?? value, set, done, key };
}
