// What may be written at a place of a formula: variables of the plan, functions and words of the
// language. Inside a text in quotes nothing is offered.

import type { FormulaWord } from '../../protocol/messages';
import type { Variable } from './model';

export interface Offer {
  name: string;
  is: 'variable' | FormulaWord['is'];
  /** Type and unit of a variable, the form of a function. */
  detail: string;
  help: string;
}

/** A place in a text: the word that the caret is in or behind. */
export interface WordAt {
  from: number;
  to: number;
}

/** null: the caret is in a text in quotes, or in a number. */
export function wordAt(text: string, caret: number): WordAt | null {
  if (isQuoted(text.slice(0, caret))) return null;
  const before = /[A-Za-z0-9_]*$/.exec(text.slice(0, caret))?.[0] ?? '';
  const after = /^[A-Za-z0-9_]*/.exec(text.slice(caret))?.[0] ?? '';
  const isNumber = /^\d/.test(before) || (before !== '' && text[caret - before.length - 1] === '.');
  return isNumber ? null : { from: caret - before.length, to: caret + after.length };
}

function isQuoted(text: string): boolean {
  let quote = '';
  for (const letter of text)
    if (quote === '') quote = letter === '"' || letter === "'" ? letter : '';
    else if (letter === quote) quote = '';
  return quote !== '';
}

/** What begins with the typed part of the word first, then what contains it; what is there already only if a person asks. */
export function offersFor(
  variables: readonly Variable[],
  words: readonly FormulaWord[],
  typed: string,
  isAsked = false,
): Offer[] {
  const wanted = typed.toLowerCase();
  const all = [...variables.map(offeredVariable), ...words.flatMap(offeredWord)];
  const at = (one: Offer) => one.name.toLowerCase().indexOf(wanted);
  const fitting = all.filter((one) => at(one) >= 0 && (isAsked || one.name !== typed));
  return [...fitting.filter((one) => at(one) === 0), ...fitting.filter((one) => at(one) > 0)];
}

function offeredVariable({ name, type, unit }: Variable): Offer {
  return { name, is: 'variable', detail: [type, unit].filter(Boolean).join(', '), help: '' };
}

/** Signs are quicker typed than chosen. */
function offeredWord({ name, is, form, help }: FormulaWord): Offer[] {
  return /^[a-z]/i.test(name) ? [{ name, is, detail: form, help }] : [];
}

/** The word is replaced; of a function the caret comes between its parentheses. */
export function completed(
  text: string,
  { from, to }: WordAt,
  { name, is }: Offer,
): { text: string; caret: number } {
  const rest = text.slice(to);
  const isCall = is === 'function';
  const parentheses = isCall && !/^\s*\(/.test(rest) ? '()' : '';
  const caret = from + name.length + (isCall ? 1 : 0);
  return { text: text.slice(0, from) + name + parentheses + rest, caret };
}
