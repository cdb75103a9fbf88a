// Where in a formula a mistake is. The checker's sentence says so: by a position, counted in bytes from 1
// (src/plan/formula.hpp), or by the name of a variable.

export interface Span {
  from: number;
  to: number;
}

const kToken = /[A-Za-z_][\w.]*|\d[\w.]*|[<>=!]=|./uy;

/** null: the whole formula is meant. */
export function mistakeIn(formula: string, sentence: string): Span | null {
  const position = /\bposition (\d+)/.exec(sentence)?.[1];
  if (position !== undefined) return tokenAt(formula, unitOfByte(formula, Number(position) - 1));
  const name = /\bthe variable "([^"]+)"/.exec(sentence)?.[1];
  return name === undefined ? null : wordIn(formula, name);
}

/** At the end of a formula its last character is meant: there is nothing else to see. */
function tokenAt(formula: string, at: number): Span | null {
  if (formula === '') return null;
  const from = Math.min(at, formula.trimEnd().length - 1);
  if (from < 0) return null;
  kToken.lastIndex = from;
  return { from, to: from + (kToken.exec(formula)?.[0].length ?? 1) };
}

function wordIn(formula: string, name: string): Span | null {
  const is = (at: number) => /[\w.]/.test(formula[at] ?? '');
  for (let at = formula.indexOf(name); at >= 0; at = formula.indexOf(name, at + 1))
    if (!is(at - 1) && !is(at + name.length)) return { from: at, to: at + name.length };
  return null;
}

function unitOfByte(text: string, byte: number): number {
  let bytes = 0;
  let units = 0;
  for (const letter of text) {
    if (bytes >= byte) break;
    bytes += new TextEncoder().encode(letter).length;
    units += letter.length;
  }
  return units;
}

const kMember = /("(?:[^"\\]|\\.)*"\s*:\s*)?"([^"\\]*)"/y;

/** The same in the line of a plan's file where the member or its value begins; null: not to be told. */
export function mistakeInLine(line: string, at: number, sentence: string): Span | null {
  kMember.lastIndex = at;
  const found = kMember.exec(line);
  if (!found) return null;
  const [, key = '', formula = ''] = found;
  const span = mistakeIn(formula, sentence);
  const begin = at + key.length + 1;
  return span && { from: begin + span.from, to: begin + span.to };
}
