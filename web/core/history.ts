// One history of undo for each document that is edited by steps (worlds, plans). Texts have the
// history of their editor.

import { temporal } from 'zundo';
import { createStore } from 'zustand/vanilla';
import type { Json, JsonStep } from '../protocol/messages';
import { applySteps } from './json_steps';

export const kUndoMax = 200;

export interface Edited {
  value: Json;
  /** The steps that led here, and those that lead back. */
  last: Change | null;
}

export interface Change {
  steps: JsonStep[];
  undo: JsonStep[];
  /** The text of the file before and after, as far as it is known: undo leads back to each byte. */
  before: string | null;
  after: string | null;
}

export type History = ReturnType<typeof createHistory>;

export function createHistory(value: Json) {
  return createStore<Edited>()(
    temporal((): Edited => ({ value, last: null }), { limit: kUndoMax }),
  );
}

export function change(
  history: History,
  steps: JsonStep[],
  before: string | null = null,
): JsonStep[] {
  const { value, undo } = applySteps(history.getState().value, steps);
  history.setState({ value, last: { steps, undo, before, after: null } });
  return steps;
}

/** Goes one change back; returns the steps that the server is to be told, or null. */
export function undo(history: History): JsonStep[] | null {
  const gone = history.getState().last;
  if (!gone || history.temporal.getState().pastStates.length === 0) return null;
  history.temporal.getState().undo();
  return gone.undo;
}

export function redo(history: History): JsonStep[] | null {
  if (history.temporal.getState().futureStates.length === 0) return null;
  history.temporal.getState().redo();
  return history.getState().last?.steps ?? null;
}

/** The file changed from elsewhere: it is shown, and the history begins anew. */
export function replace(history: History, value: Json): void {
  history.setState({ value, last: null });
  history.temporal.getState().clear();
}
