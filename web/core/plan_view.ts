// The plan that runs, as a list shows it.

import type { Doc, Json, PlanLevel, PlanVariable } from '../protocol/messages';

/** The level that is shown: the chosen one, else the innermost of the document, else the innermost. */
export function shownLevel(levels: readonly PlanLevel[], doc: Doc, chosen: string | null): number {
  const byPath = levels.findIndex((level) => level.path === chosen);
  if (byPath >= 0) return byPath;
  const ofDoc = levels.findLastIndex((level) => level.doc === doc);
  return ofDoc >= 0 ? ofDoc : levels.length - 1;
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
