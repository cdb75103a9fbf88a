// Finds commands by letters of their titles, in order, best first.

import type { Command } from './registry';

export interface Ranked {
  command: Command;
  /** Places of the letters that were typed. */
  marked: ReadonlySet<number>;
  score: number;
}

export function rankCommands(
  commands: readonly Command[],
  query: string,
  enabled: (id: string) => boolean,
): Ranked[] {
  const found: Ranked[] = [];
  for (const command of commands) {
    const marked = fuzzy(command.title, query);
    if (marked)
      found.push({
        command,
        marked: new Set(marked),
        score:
          scoreOf(command.title, marked) +
          (isAsTyped(command.title, marked) ? 0 : 2000) +
          (enabled(command.id) ? 0 : 1000),
      });
  }
  return found.sort(
    (a, b) => a.score - b.score || a.command.title.localeCompare(b.command.title, 'en'),
  );
}

/** Places of the query's letters in the title; whole words are preferred; null if they are not there. */
export function fuzzy(title: string, query: string): number[] | null {
  const low = title.toLowerCase();
  const wanted = query.toLowerCase().replaceAll(' ', '');
  const whole = low.indexOf(query.trim().toLowerCase());
  if (whole >= 0) return Array.from({ length: query.trim().length }, (_, index) => whole + index);
  const marked: number[] = [];
  let at = 0;
  for (const letter of wanted) {
    at = low.indexOf(letter, at);
    if (at < 0) return null;
    marked.push(at++);
  }
  return marked;
}

/** In one piece, from the beginning of a word: meant rather than letters from here and there. */
function isAsTyped(title: string, marked: readonly number[]): boolean {
  const [first = 0] = marked;
  const apart = (marked.at(-1) ?? first) - first >= marked.length;
  return !apart && (first === 0 || title[first - 1] === ' ');
}

/** Small is good: near the beginning and close together. */
export function scoreOf(title: string, marked: readonly number[]): number {
  const first = marked[0];
  if (first === undefined) return 0;
  const spread = (marked.at(-1) ?? first) - first + 1 - marked.length;
  const inWord = first > 0 && title[first - 1] !== ' ';
  return first + spread * 4 + (inWord ? 20 : 0);
}
