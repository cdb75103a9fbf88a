// Steps kept beside the change of the text that they are: what was meant, what takes it back, and
// where in the text that is. So a step can be done again from its meaning when another's change has
// come between, and undo can tell whether what it leads to is still what was meant.

import { MapMode, StateEffect, type ChangeDesc, type Transaction } from '@codemirror/state';
import type { Json, JsonStep } from '../../protocol/messages';
import { applySteps } from '../json_steps';
import { patch, type Patched } from './json_patch';
import { indexIn, readTree, type Key, type Tree } from './json_text';

/** The first character of the deepest value on the way of a step that is in the text. */
export interface Anchor {
  /** null: somebody has removed it. */
  at: number | null;
  /** So many of the step's keys lead to it. */
  depth: number;
}

/** As many steps can be found again: more than are taken back. */
export const kAnchorsMax = 1000;

export interface Noted {
  steps: readonly JsonStep[];
  back: readonly JsonStep[];
}

export const noted = StateEffect.define<Noted>();

/** A change that only puts right what others' changes have made of steps. */
export const corrects = StateEffect.define<null>();

export function movedBy({ at, depth }: Anchor, mapping: ChangeDesc): Anchor {
  return { at: at === null ? null : mapping.mapPos(at, 1, MapMode.TrackAfter), depth };
}

/** What steps do to the text. Throws if they do not fit. */
export function stepped(
  text: string,
  language: string,
  steps: readonly JsonStep[],
): Patched & { note: Noted } {
  const { undo } = applySteps(JSON.parse(text) as Json, steps);
  return { ...patch(text, language, steps), note: { steps: [...steps], back: undo } };
}

/** What history keeps of a transaction with steps: those that take them back. */
export function takenBack({ effects }: Transaction): StateEffect<unknown>[] {
  return notesOf(effects)
    .map(({ steps, back }) => noted.of({ steps: back, back: steps }))
    .reverse();
}

/** Where in the text the steps of a history are that may be taken back. */
export class Anchors {
  private readonly known = new Map<readonly JsonStep[], Anchor>();

  of(steps: readonly JsonStep[]): Anchor {
    return this.known.get(steps) ?? { at: null, depth: 0 };
  }

  /** Follows the text. */
  follow({ docChanged, changes, effects, newDoc }: Transaction): void {
    if (docChanged)
      for (const [steps, anchor] of this.known) this.known.set(steps, movedBy(anchor, changes));
    const notes = notesOf(effects);
    const tree = notes.length > 0 ? treeIfGood(newDoc.toString()) : null;
    for (const { steps, back } of notes) {
      this.known.delete(steps);
      if (tree) this.known.set(back, anchorOf(tree, back[0]?.at ?? []));
    }
    for (const [oldest] of this.known) {
      if (this.known.size <= kAnchorsMax) break;
      this.known.delete(oldest);
    }
  }
}

export function notesOf(effects: readonly StateEffect<unknown>[] | undefined): Noted[] {
  return (effects ?? []).flatMap((effect) => (effect.is(noted) ? [effect.value] : []));
}

export function anchorOf(tree: Tree, path: readonly Json[]): Anchor {
  let value = tree;
  let depth = 0;
  for (const key of path as readonly Key[]) {
    const part = value.parts[indexIn(value, key)];
    if (!part) break;
    value = part.value;
    depth++;
  }
  return { at: value.at, depth };
}

/** The steps with the way that leads to the same place in this text; null: it is gone. */
export function relocated(
  steps: readonly JsonStep[],
  anchor: Anchor,
  tree: Tree,
): readonly JsonStep[] | null {
  const way = anchor.at === null ? null : wayTo(tree, anchor.at);
  if (!way) return null;
  const before = (steps[0]?.at ?? []).slice(0, anchor.depth);
  if (isSamePath(before, way)) return steps;
  return steps.map((step) =>
    isSamePath(step.at.slice(0, anchor.depth), before)
      ? { ...step, at: [...way, ...step.at.slice(anchor.depth)] }
      : step,
  );
}

function isSamePath(a: readonly Json[], b: readonly Json[]): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}

/** The keys that lead to the value that begins there. */
function wayTo(tree: Tree, at: number): Key[] | null {
  if (tree.at === at) return [];
  for (const [index, { key, value }] of tree.parts.entries()) {
    const way = wayTo(value, at);
    if (way) return [tree.kind === 'object' ? key : index, ...way];
  }
  return null;
}

/** Of a text that is JSON without a key that is there twice. */
export function treeIfGood(text: string): Tree | null {
  try {
    JSON.parse(text);
  } catch {
    return null;
  }
  const tree = readTree(text);
  return hasTwins(tree) ? null : tree;
}

function hasTwins({ kind, parts }: Tree): boolean {
  if (kind === 'object' && new Set(parts.map(({ key }) => key)).size < parts.length) return true;
  return parts.some(({ value }) => hasTwins(value));
}
