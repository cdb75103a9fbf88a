// What becomes of steps when another's change has come between: their text is moved with it, and if
// the file is then not what they meant, they are done again from their meaning, or refused.

import type { Update } from '@codemirror/collab';
import { ChangeSet, type Text } from '@codemirror/state';
import type { JsonStep } from '../../protocol/messages';
import { textDiff } from '../text_diff';
import { patch } from './json_patch';
import type { Tree } from './json_text';
import {
  anchorOf,
  corrects,
  movedBy,
  notesOf,
  relocated,
  treeIfGood,
  type Anchors,
  type Noted,
} from './steps';

export function changeTo(before: string, after: string): ChangeSet {
  return ChangeSet.of(textDiff(before, after), before.length);
}

/** The text is JSON, and no value was joined with what is beside it. */
export function isAsMeant(after: string, made: readonly ChangeSet[]): boolean {
  return treeIfGood(after) !== null && !made.some((one) => joinsWords(after, one));
}

function joinsWords(after: string, made: ChangeSet): boolean {
  let joined = false;
  const isWord = (at: number) => /[\w.+-]/.test(after.charAt(at));
  made.iterChangedRanges((_fromA, _toA, from, to) => {
    for (const at of [from, to]) joined ||= isWord(at - 1) && isWord(at);
  }, true);
  return joined;
}

export interface Others {
  /** What both had, and what the others have made of it. */
  base: Text;
  changes: ChangeSet;
  /** What was done here, before and after it was moved over theirs. */
  before: readonly Update[];
  after: readonly Update[];
}

export interface Again {
  text: string;
  refused: string[];
}

/**
 * The text in which the steps are done again from their meaning, on what the others have made; null
 * if that is no JSON: then they wait, moved as text.
 */
export function doneAgain(
  { base, changes, before, after }: Others,
  language: string,
  given: WeakSet<readonly JsonStep[]>,
): Again | null {
  const theirs = changes.apply(base).toString();
  const tree = treeIfGood(theirs);
  if (!tree) return null;
  const old = treeIfGood(base.toString());
  const refused: string[] = [];
  let text = theirs;
  let moved = changes.apply(base);
  before.forEach((update, index) => {
    const asText = after[index]?.changes ?? ChangeSet.empty(moved.length);
    const notes = notesOf(update.effects);
    if (notes.length === 0 && !update.effects?.some((one) => one.is(corrects))) {
      const here = asText.map(changeTo(moved.toString(), text));
      text = applied(here, text);
    }
    for (const note of notes) {
      const steps = old
        ? relocated(note.steps, movedBy(anchorOf(old, pathOf(note)), changes), tree)
        : note.steps;
      const next = given.has(note.steps) ? null : patchedBy(text, language, steps);
      if (next === null && !given.has(note.steps)) refused.push(placeOf(note));
      if (next === null) given.add(note.steps);
      text = next ?? text;
    }
    moved = asText.apply(moved);
  });
  return { text, refused };
}

/** The text after steps that take something back; null if the place is gone. */
export function unstepped(
  text: string,
  language: string,
  notes: readonly Noted[],
  anchors: Anchors,
): string | null {
  let current: string | null = text;
  for (const [index, { steps }] of notes.entries()) {
    const tree: Tree | null = current === null ? null : treeIfGood(current);
    if (current === null || !tree) return null;
    // Anchors are places in the text before the first of them.
    const there = index === 0 ? relocated(steps, anchors.of(steps), tree) : steps;
    current = patchedBy(current, language, there);
  }
  return current;
}

function patchedBy(
  text: string,
  language: string,
  steps: readonly JsonStep[] | null,
): string | null {
  if (!steps) return null;
  try {
    return patch(text, language, steps).text;
  } catch {
    return null;
  }
}

function applied(changes: ChangeSet, text: string): string {
  let result = '';
  let at = 0;
  changes.iterChanges((from, to, _fromB, _toB, inserted) => {
    result += text.slice(at, from) + inserted.toString();
    at = to;
  }, true);
  return result + text.slice(at);
}

const pathOf = ({ steps }: Noted) => steps[0]?.at ?? [];

function placeOf(note: Noted): string {
  return pathOf(note).join(' / ');
}
