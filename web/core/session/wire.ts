// What a session and the server say to each other about one file.

import type { ChangeSet } from '@codemirror/state';

export interface Change {
  from: number;
  to: number;
  text: string;
}

/** One edit that the server has taken; `version` is the one that it leads to. */
export interface Update {
  version: number;
  changes: readonly Change[];
  /** Who made it: see FileSync. */
  by: string;
}

/** Applied or up to date; behind: these are missing; a text: go on from it. */
export interface Answer {
  version: number;
  behind?: readonly Update[] | undefined;
  epoch?: string | undefined;
  text?: string | undefined;
}

export interface DocLink {
  edit(order: {
    epoch: string;
    version: number;
    by: string;
    changes: readonly Change[];
  }): Promise<Answer>;
  pull(from: { epoch: string; version: number }): Promise<Answer>;
}

/** So many changes fit into one edit. */
export const kChangesMax = 1000;

export function changesOf(set: ChangeSet): Change[] {
  const changes: Change[] = [];
  set.iterChanges((from, to, _fromAfter, _toAfter, inserted) =>
    changes.push({ from, to, text: inserted.toString() }),
  );
  return changes;
}

export function specOf(changes: readonly Change[]): { from: number; to: number; insert: string }[] {
  return changes.map(({ from, to, text }) => ({ from, to, insert: text }));
}
