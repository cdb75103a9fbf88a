// One history of undo for each document that is edited by steps (worlds, plans). Texts have the
// history of their editor.

import { temporal } from 'zundo';
import { createStore } from 'zustand/vanilla';
import type { Json, JsonStep } from '../protocol/messages';
import { applySteps } from './json_steps';

export const kUndoMax = 200;
/** Changes of one row that follow each other within this time are one change. */
export const kRowMs = 1000;

/** What a change is one of: the keys that move one thing. Its steps set members of their own. */
export interface Row {
  of: string;
  at: number;
}

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
  row?: Row | undefined;
}

export type History = ReturnType<typeof createHistory>;

export function createHistory(value: Json) {
  return createStore<Edited>()(
    temporal((): Edited => ({ value, last: null }), { limit: kUndoMax }),
  );
}

/** `before`: the text of the file, if it is known. */
export function change(
  history: History,
  steps: JsonStep[],
  before: string | null = null,
  row?: Row,
): JsonStep[] {
  const { value, last } = history.getState();
  const after = applySteps(value, steps);
  const made: Change = { steps, undo: after.undo, before, after: null, row };
  const { futureStates, pause, resume } = history.temporal.getState();
  if (last && futureStates.length === 0 && goesOn(last.row, row)) {
    pause();
    history.setState({ value: after.value, last: merged(last, made) });
    resume();
  } else history.setState({ value: after.value, last: made });
  return steps;
}

function goesOn(before: Row | undefined, now: Row | undefined): boolean {
  return before !== undefined && before.of === now?.of && now.at - before.at < kRowMs;
}

/** Each member once: set to what it is last, taken back to what it was first. */
function merged(first: Change, then: Change): Change {
  const elsewhere = (steps: JsonStep[]) => {
    const places = new Set(steps.map(placeOf));
    return (one: JsonStep) => !places.has(placeOf(one));
  };
  return {
    steps: [...first.steps.filter(elsewhere(then.steps)), ...then.steps],
    undo: [...then.undo.filter(elsewhere(first.undo)), ...first.undo],
    before: first.before,
    after: null,
    row: then.row,
  };
}

function placeOf(step: JsonStep): string {
  return JSON.stringify(step.at);
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
