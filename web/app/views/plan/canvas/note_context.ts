// What a note on the canvas can do with itself; null: nothing may be changed.

import { createContext, useMemo } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import { writeNote, type Size } from '../../../../core/plan/notes';

export interface NoteActs {
  /** False: not now. */
  write(key: string, text: string): boolean;
  /** While its corner is dragged. */
  hold(key: string, size: Size): void;
  letGo(): void;
}

export const NoteContext = createContext<NoteActs | null>(null);

export function useNoteActs(board: PlanBoard, drives: boolean): NoteActs | null {
  return useMemo(
    () =>
      drives
        ? {
            write(key, text) {
              const note = board.note(key);
              return !note || board.commit(writeNote(note, text));
            },
            hold: (key, size) => board.holdSize(key, size),
            letGo: () => board.letGo(),
          }
        : null,
    [board, drives],
  );
}
