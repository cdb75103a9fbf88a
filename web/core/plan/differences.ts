// What differs between two versions of a plan, as its drawing marks it: which element or arrow each
// difference is about, in the form in which the server tells it.

import type { Json, PlanDifference } from '../../protocol/messages';
import { arrowId } from './arrows';
import { pillKey } from './board';
import { tableOf } from './json';
import { kStart } from './model';

export type MarkKind = 'added' | 'changed' | 'removed';

/** Something of the drawing that a difference is about: an element, or an arrow by its id. */
export interface Mark {
  key: string;
  kind: MarkKind;
}

type Path = readonly string[];

/** Where an element is drawn: places are no difference that is marked. */
export const isPlace = ({ path }: PlanDifference): boolean => path[0] === 'layout';

/**
 * All that a difference marks; none: it is about the plan as a whole. What comes or goes with its
 * element is marked with it: its supervisors, its arrows.
 */
export function marksOf(difference: PlanDifference): Mark[] {
  const { kind, path, before, after } = difference;
  if (isPlace(difference)) return [];
  if (kind === 'added') return marked(path, after, kind);
  if (kind === 'removed') return marked(path, before, kind);
  const about = elementAt(path);
  return about === null ? [] : [{ key: about.key, kind: 'changed' }];
}

/** What the current drawing marks, by key; what is changed in two ways is changed. */
export function marksIn(differences: readonly PlanDifference[]): Map<string, MarkKind> {
  const marks = new Map<string, MarkKind>();
  for (const { key, kind } of differences.flatMap(marksOf)) {
    if (kind === 'removed') continue;
    const known = marks.get(key);
    if (known !== 'added') marks.set(key, kind);
  }
  return marks;
}

/** What is no more: keys of elements, ids of arrows. */
export function removedIn(differences: readonly PlanDifference[]): Set<string> {
  return new Set(
    differences.flatMap(marksOf).flatMap(({ key, kind }) => (kind === 'removed' ? key : [])),
  );
}

/** Arrows that lead elsewhere now. */
export function movedIn(differences: readonly PlanDifference[]): Set<string> {
  return new Set(
    differences.flatMap((one) => {
      const about = one.kind === 'changed' && elementAt(one.path);
      return about && about.isArrow ? about.key : [];
    }),
  );
}

interface Element {
  key: string;
  isArrow: boolean;
  /** The path leads to it, not into it. */
  isWhole: boolean;
}

/** The element or arrow that a path leads to, or into; null: the plan, or a list of it. */
export function elementAt(path: Path): Element | null {
  const [first, name, list, ...rest] = path;
  if (first === 'configuration' && name !== undefined)
    return { key: pillKey(name), isArrow: false, isWhole: path.length === 2 };
  if (first === 'start') return inStart(path);
  if (first !== 'actors' || name === undefined) return null;
  if (list === 'supervisors' && rest[0] !== undefined)
    return inSupervisor(`${name}/${rest[0]}`, rest.slice(1));
  if (list === 'states' && rest[0] !== undefined) return arrow(name, rest[0]);
  return { key: name, isArrow: false, isWhole: path.length === 2 };
}

function inStart([, list, name, ...rest]: Path): Element {
  if (list === 'actor') return arrow(kStart, '');
  if (list === 'supervisors' && name !== undefined) return inSupervisor(`${kStart}/${name}`, rest);
  return { key: kStart, isArrow: false, isWhole: list === undefined };
}

function inSupervisor(key: string, [list, event]: Path): Element {
  if (list === 'events' && event !== undefined) return arrow(key, event);
  return { key, isArrow: false, isWhole: list === undefined };
}

const arrow = (source: string, outcome: string): Element => ({
  key: arrowId(source, outcome),
  isArrow: true,
  isWhole: true,
});

/** Lists of named things: of those that came or went as a whole each member did. */
const kLists = ['actors', 'configuration', 'supervisors', 'states', 'events'];

function marked(path: Path, value: Json | undefined, kind: MarkKind): Mark[] {
  const list = path.at(-1);
  const isList = list !== undefined && kLists.includes(list) && !isName(path);
  const members = Object.entries(tableOf(value));
  if (isList) return members.flatMap(([name, one]) => marked([...path, name], one, kind));
  const about = elementAt(path);
  if (about === null) return [];
  if (!about.isWhole) return [{ key: about.key, kind: 'changed' }];
  if (about.isArrow) return [{ key: about.key, kind }];
  // The start is always drawn: with its first actor or without.
  const own: Mark[] = about.key === kStart ? [] : [{ key: about.key, kind }];
  const parts = members.filter(([name]) => isPart(path, name));
  return [...own, ...parts.flatMap(([name, one]) => marked([...path, name], one, kind))];
}

/** What an element has that is drawn as something of its own. */
const isPart = ([first]: Path, name: string): boolean =>
  ['states', 'supervisors', 'events'].includes(name) || (first === 'start' && name === 'actor');

/** An actor, supervisor or variable may be called as a list is. */
function isName(path: Path): boolean {
  const list = path.at(-2);
  return list !== undefined && kLists.includes(list) && !isName(path.slice(0, -1));
}
