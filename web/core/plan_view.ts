// The plan that runs, as a list shows it.

import type { Doc, Json, PlanLevel, PlanVariable } from '../protocol/messages';

/** The level that is shown: the chosen one, else the innermost of the document, else the innermost. */
export function shownLevel(levels: readonly PlanLevel[], doc: Doc, chosen: string | null): number {
  const byPath = levels.findIndex((level) => level.path === chosen);
  if (byPath >= 0) return byPath;
  const ofDoc = levels.findLastIndex((level) => level.doc === doc);
  return ofDoc >= 0 ? ofDoc : levels.length - 1;
}

/** The variable of that name, as the outermost plan has it that has one. */
export function variableNamed(
  levels: readonly PlanLevel[],
  name: string,
): PlanVariable | undefined {
  return levels.flatMap((level) => level.variables).find((one) => one.name === name);
}

/** As a curve shows it; undefined: it is neither a number nor true or false. */
export function numberOf(value: Json): number | undefined {
  if (typeof value === 'boolean') return value ? 1 : 0;
  return typeof value === 'number' ? value : undefined;
}

export function valueOf(value: Json): string {
  return typeof value === 'string' ? value : JSON.stringify(value);
}

/** What was typed as a value of the variable; undefined: it cannot be one. */
export function typedValue(type: PlanVariable['type'], typed: string): Json | undefined {
  const text = typed.trim();
  switch (type) {
    case 'string':
      return typed;
    case 'bool':
      return text === 'true' ? true : text === 'false' ? false : undefined;
    case 'int':
      return /^[+-]?\d{1,15}$/.test(text) ? Number(text) : undefined;
    case 'float': {
      const number = Number(text.replace(',', '.'));
      return text !== '' && Number.isFinite(number) ? number : undefined;
    }
    case 'object':
      return undefined;
  }
}
