// A fleet as its page shows it: what each robot does, which are shown in which order, which are
// chosen, and what became of an order.

import type { FleetOutcome, FleetRobot } from '../protocol/messages';

/** What a person wants to know first, the worst first. */
export const doings = [
  'fault',
  'stuck',
  'lost',
  'waiting',
  'running',
  'paused',
  'stopped',
  'offline',
] as const;
export type Doing = (typeof doings)[number];

/**
 * stuck: it is connected, but has told nothing for some time: its program hangs. Without a broker
 * nobody knows: what a robot did last is shown then.
 */
export function doingOf(robot: FleetRobot, isConnected: boolean): Doing {
  if (robot.connection === 'offline' || robot.connection === 'lost') return robot.connection;
  if (!isConnected) return robot.state ?? 'waiting';
  if (robot.age === 'stale') return robot.connection === 'online' ? 'stuck' : 'lost';
  return robot.age === 'fresh' ? (robot.state ?? 'waiting') : 'waiting';
}

export type Counts = Readonly<Record<Doing, number>>;

export function countDoings(robots: Robots, isConnected: boolean): Counts {
  const counts = Object.fromEntries(doings.map((one) => [one, 0])) as Record<Doing, number>;
  for (const robot of Object.values(robots)) counts[doingOf(robot, isConnected)]++;
  return counts;
}

// ---- which, in which order ----

export type Robots = Readonly<Record<string, FleetRobot>>;

export const sorts = ['name', 'state', 'since', 'version'] as const;
export type Sort = (typeof sorts)[number];

const names = new Intl.Collator('en', { numeric: true });

/** Names of robots that have every word that is looked for, r2 before r10. */
export function listOf(robots: Robots, query: string, sort: Sort, isConnected: boolean): string[] {
  const words = query.toLowerCase().split(/\s+/).filter(Boolean);
  const entries = Object.entries(robots).filter(
    ([name, robot]) => words.length === 0 || hasWords(name, robot, words, isConnected),
  );
  const order = orders[sort](isConnected);
  return entries
    .toSorted(([a, one], [b, other]) => order(one, other) || names.compare(a, b))
    .map(([name]) => name);
}

function hasWords(
  name: string,
  robot: FleetRobot,
  words: readonly string[],
  isConnected: boolean,
): boolean {
  const text = [
    name,
    doingOf(robot, isConnected),
    robot.actor ?? '',
    robot.project ?? '',
    robot.vagus ?? '',
    ...(robot.groups ?? []),
    ...(robot.problems ?? []),
  ]
    .join('\n')
    .toLowerCase();
  return words.every((word) => text.includes(word));
}

type Order = (one: FleetRobot, other: FleetRobot) => number;

const orders: Record<Sort, (isConnected: boolean) => Order> = {
  name: () => () => 0,
  state: (isConnected) => (one, other) => rank(one, isConnected) - rank(other, isConnected),
  since: () => (one, other) => (one.since_wall ?? Infinity) - (other.since_wall ?? Infinity) || 0,
  version: () => (one, other) =>
    names.compare(one.project ?? '', other.project ?? '') ||
    names.compare(one.vagus ?? '', other.vagus ?? ''),
};

/** A robot with problems comes before others that do the same. */
function rank(robot: FleetRobot, isConnected: boolean): number {
  const troubled = (robot.problems?.length ?? 0) > 0;
  return doings.indexOf(doingOf(robot, isConnected)) * 2 - (troubled ? 1 : 0);
}

// ---- choosing many ----

export interface Choice {
  readonly chosen: ReadonlySet<string>;
  /** The tile that the keyboard is on. */
  readonly at: string | null;
  /** Where a range begins. */
  readonly from: string | null;
}
export const noChoice: Choice = { chosen: new Set(), at: null, from: null };

export type Hold = Readonly<{ shift: boolean; ctrl: boolean }>;

/** As in a list of files: one, one more with Ctrl, a range with Shift. */
export function clicked(choice: Choice, list: readonly string[], name: string, hold: Hold): Choice {
  if (hold.shift) return ranged(choice, list, name);
  if (hold.ctrl) return toggled(choice, name);
  return { chosen: new Set([name]), at: name, from: name };
}

export function toggled(choice: Choice, name: string): Choice {
  const chosen = new Set(choice.chosen);
  if (!chosen.delete(name)) chosen.add(name);
  return { chosen, at: name, from: name };
}

export function allOf(choice: Choice, list: readonly string[]): Choice {
  return { ...choice, chosen: new Set(list) };
}

function ranged(choice: Choice, list: readonly string[], to: string): Choice {
  const from = choice.from !== null && list.includes(choice.from) ? choice.from : to;
  const ends = [list.indexOf(from), list.indexOf(to)].toSorted((a, b) => a - b);
  return { chosen: new Set(list.slice(ends[0], (ends[1] ?? 0) + 1)), at: to, from };
}

/** The keys of the tiles; null: none of theirs. columns: tiles in a row. */
export function keyed(
  choice: Choice,
  list: readonly string[],
  key: string,
  columns: number,
  hold: Hold,
): Choice | null {
  const at = Math.max(0, list.indexOf(choice.at ?? ''));
  if (key === ' ') {
    const name = list[at];
    return name === undefined
      ? null
      : hold.shift
        ? ranged(choice, list, name)
        : toggled(choice, name);
  }
  if (key === 'a' && hold.ctrl) return allOf(choice, list);
  if (key === 'Escape') return choice.chosen.size > 0 ? { ...choice, chosen: new Set() } : null;
  const next = steps(key, at, columns, list.length);
  const name = next === null ? undefined : list[Math.min(Math.max(next, 0), list.length - 1)];
  if (name === undefined) return null;
  return hold.shift ? ranged(choice, list, name) : { ...choice, at: name, from: name };
}

/** So far goes a page: some rows of a window that is not large, so that none is passed over unseen. */
const kRowsOfPage = 4;

function steps(key: string, at: number, columns: number, count: number): number | null {
  switch (key) {
    case 'ArrowRight':
      return at + 1;
    case 'ArrowLeft':
      return at - 1;
    // The last row may be shorter: a tile below is one of it, or there is none.
    case 'ArrowDown':
      return at + columns < count ? at + columns : at;
    case 'ArrowUp':
      return at - columns >= 0 ? at - columns : at;
    case 'PageDown':
      return at + columns * Math.min(kRowsOfPage, Math.floor((count - 1 - at) / columns));
    case 'PageUp':
      return at - columns * Math.min(kRowsOfPage, Math.floor(at / columns));
    case 'Home':
      return 0;
    case 'End':
      return count - 1;
    default:
      return null;
  }
}

// ---- orders ----

/** So many robots are told at once; the server takes no more. */
export const kRobotsAtOnce = 500;

export function inBatches(robots: readonly string[]): string[][] {
  const batches: string[][] = [];
  for (let at = 0; at < robots.length; at += kRobotsAtOnce)
    batches.push(robots.slice(at, at + kRobotsAtOnce));
  return batches;
}

/** Robots by what became of an order. */
export function sortedOutcomes(outcomes: readonly FleetOutcome[]) {
  const of = (result: FleetOutcome['result']) =>
    outcomes
      .filter((one) => one.result === result)
      .toSorted((a, b) => names.compare(a.robot, b.robot));
  return { done: of('done'), refused: of('refused'), silent: of('silent'), away: of('away') };
}

/** "NODE.NAME" of a node's variable, "NAME" of the plan's. */
export function readVariable(text: string): { node?: string; name: string } | null {
  const dot = text.indexOf('.');
  const name = text.slice(dot + 1).trim();
  const node = dot < 0 ? '' : text.slice(0, dot).trim();
  if (name === '' || (dot >= 0 && node === '')) return null;
  return node === '' ? { name } : { node, name };
}

// ---- time ----

/** "12 s", "3 min", "2 h", "5 d". */
export function shownSpan(milliseconds: number): string {
  const seconds = Math.max(0, Math.floor(milliseconds / 1000));
  if (seconds < 60) return `${seconds} s`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min`;
  if (seconds < 86_400) return `${Math.floor(seconds / 3600)} h`;
  return `${Math.floor(seconds / 86_400)} d`;
}
