// Says whether a value that arrived has the shape that the protocol promises. Checked once, at the
// border; behind it the types carry the proof. Unknown members are let through: a newer server may
// say more.

import { typeTable } from './messages';
import { readField, readShape, type Field, type Shape } from './shape';

type Fields = Readonly<Record<string, string>>;

const fieldCache = new WeakMap<Fields, Map<string, Field>>();
const shapeCache = new Map<string, Shape>();

/** Returns '' or the place of the first member that does not fit. */
export function misfit(value: unknown, fields: Fields, only?: ReadonlySet<string>): string {
  if (!isObject(value)) return 'no object';
  for (const [name, field] of parsed(fields)) {
    if (only && !only.has(name)) continue;
    const member = value[name];
    if (member === undefined || member === null) {
      if (!field.optional && field.shape.is !== 'json') return name;
      continue;
    }
    const inner = misfitOf(member, field.shape);
    if (inner !== null) return inner === '' ? name : `${name}.${inner}`;
  }
  return '';
}

/** The same for a value of a named type. */
export function misfitItem(value: unknown, type: string): string | null {
  return misfitOf(value, shapeOf(type));
}

/** null: it fits; otherwise where it does not, '' for the value itself. */
function misfitOf(value: unknown, shape: Shape): string | null {
  switch (shape.is) {
    case 'text':
      return typeof value === 'string' ? null : '';
    case 'number':
      return typeof value === 'number' ? null : '';
    case 'bool':
      return typeof value === 'boolean' ? null : '';
    case 'json':
      return null;
    case 'word':
      return typeof value === 'string' && shape.words.includes(value) ? null : '';
    case 'list':
      return Array.isArray(value) ? firstMisfit(value.entries(), shape.of) : '';
    case 'table':
      return isObject(value) ? firstMisfit(Object.entries(value), shape.of) : '';
    case 'named':
      return misfitNamed(value, shape.name);
  }
}

function misfitNamed(value: unknown, name: string): string | null {
  const type = typeTable[name];
  if (type === undefined) return '';
  if (typeof type === 'string') return misfitOf(value, shapeOf(type));
  const found = misfit(value, type);
  return found === '' ? null : found;
}

function firstMisfit(entries: Iterable<[string | number, unknown]>, shape: Shape): string | null {
  for (const [key, member] of entries) {
    const inner = misfitOf(member, shape);
    if (inner !== null) return inner === '' ? String(key) : `${key}.${inner}`;
  }
  return null;
}

function parsed(fields: Fields): Map<string, Field> {
  let known = fieldCache.get(fields);
  if (!known) {
    known = new Map(Object.entries(fields).map(([name, text]) => [name, readField(text)]));
    fieldCache.set(fields, known);
  }
  return known;
}

function shapeOf(type: string): Shape {
  let known = shapeCache.get(type);
  if (!known) shapeCache.set(type, (known = readShape(type)));
  return known;
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
