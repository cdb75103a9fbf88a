// Changes of a JSON file as steps (doc.patch), applied to a value that is never changed in place,
// with the steps that undo them. What worlds and plans are edited by.

import type { Json, JsonStep } from '../protocol/messages';

export interface Stepped {
  value: Json;
  /** Takes the steps back, to be applied in this order. */
  undo: JsonStep[];
}

/** As they go to the server: objects as text, in which the order of their keys is kept. */
export function asSent(steps: readonly JsonStep[]): JsonStep[] {
  return steps.map(({ value, ...step }) => {
    if (value === undefined) return step;
    const isPlain = typeof value !== 'object' || value === null;
    return isPlain ? { ...step, value } : { ...step, text: JSON.stringify(value) };
  });
}

export function applySteps(value: Json, steps: readonly JsonStep[]): Stepped {
  const undo: JsonStep[] = [];
  let current = value;
  for (const step of steps) {
    const [next, back] = applyStep(current, step, 0);
    current = next;
    undo.unshift(...back);
  }
  return { value: current, undo };
}

function applyStep(value: Json, step: JsonStep, depth: number): [Json, JsonStep[]] {
  const key = step.at[depth];
  if (depth === step.at.length - 1) return applyHere(value, key, step);
  if (Array.isArray(value) && typeof key === 'number' && key in value) {
    const [inner, back] = applyStep(value[key] ?? null, step, depth + 1);
    return [value.with(key, inner), back];
  }
  if (isTable(value) && typeof key === 'string' && Object.hasOwn(value, key)) {
    const [inner, back] = applyStep(value[key] ?? null, step, depth + 1);
    return [{ ...value, [key]: inner }, back];
  }
  throw new Error(`There is nothing at ${JSON.stringify(step.at)}.`);
}

function applyHere(value: Json, key: Json | undefined, step: JsonStep): [Json, JsonStep[]] {
  if (Array.isArray(value) && typeof key === 'number') {
    const [next, back] = applyToList(value, key, step);
    return [next, [back]];
  }
  if (isTable(value) && typeof key === 'string') return applyToTable(value, key, step);
  throw new Error(`There is nothing at ${JSON.stringify(step.at)}.`);
}

function applyToList(list: Json[], index: number, step: JsonStep): [Json, JsonStep] {
  const { at } = step;
  const to = step.to ?? 0;
  switch (step.do) {
    case 'set':
      return [list.with(index, step.value ?? null), { do: 'set', at, value: list[index] ?? null }];
    case 'remove':
      return [list.toSpliced(index, 1), { do: 'insert', at, value: list[index] ?? null }];
    case 'insert':
      return [list.toSpliced(index, 0, step.value ?? null), { do: 'remove', at }];
    case 'move':
      return [
        list.toSpliced(index, 1).toSpliced(to, 0, list[index] ?? null),
        { do: 'move', at: [...at.slice(0, -1), to], to: index },
      ];
  }
}

/** The order of members counts: one that comes back comes back to its place. */
function applyToTable(
  table: Record<string, Json>,
  key: string,
  step: JsonStep,
): [Json, JsonStep[]] {
  const { at } = step;
  const index = Object.keys(table).indexOf(key);
  const before: JsonStep[] =
    index >= 0 ? [{ do: 'set', at, value: table[key] ?? null }] : [{ do: 'remove', at }];
  switch (step.do) {
    case 'set':
      return [{ ...table, [key]: step.value ?? null }, before];
    case 'remove': {
      const { [key]: _gone, ...rest } = table;
      return [rest, [...before, { do: 'move', at, to: index }]];
    }
    case 'move':
      if (index < 0) throw new Error(`There is nothing at ${JSON.stringify(at)}.`);
      return [moved(table, index, step.to ?? 0), [{ do: 'move', at, to: index }]];
    case 'insert':
      throw new Error(`"insert" is for lists; ${JSON.stringify(at)} is in an object.`);
  }
}

function moved(table: Record<string, Json>, from: number, to: number): Record<string, Json> {
  const members = Object.entries(table);
  return Object.fromEntries(
    members.toSpliced(from, 1).toSpliced(to, 0, ...members.slice(from, from + 1)),
  );
}

function isTable(value: Json): value is Record<string, Json> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
