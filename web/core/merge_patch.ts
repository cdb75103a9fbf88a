// JSON merge patch (RFC 7396) on values that are never changed in place: what a patch does not touch
// keeps its identity, so that a view need not draw it again.

import type { Json } from '../protocol/messages';

export function mergePatch(value: Json | undefined, patch: Json): Json {
  if (!isTable(patch)) return patch;
  const before: { [key: string]: Json } = isTable(value) ? value : {};
  const after: { [key: string]: Json } = { ...before };
  for (const [key, change] of Object.entries(patch)) {
    if (change === null) delete after[key];
    else Object.defineProperty(after, key, member(mergePatch(own(before, key), change)));
  }
  return after;
}

// A key "__proto__" is a member like any other.
function member(value: Json): PropertyDescriptor {
  return { value, enumerable: true, configurable: true, writable: true };
}

function own(table: { [key: string]: Json }, key: string): Json | undefined {
  return Object.hasOwn(table, key) ? table[key] : undefined;
}

function isTable(value: Json | undefined): value is { [key: string]: Json } {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
