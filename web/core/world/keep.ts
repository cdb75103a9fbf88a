// "Keep in the world": what a hand did in a run, as steps of the world's file.

import type { Json, JsonStep } from '../../protocol/messages';
import { applySteps } from '../json_steps';
import {
  addSteps,
  freeName,
  keyOf,
  listOf,
  moveSteps,
  numberOf,
  pairOf,
  partOfKey,
  removeSteps,
  setSteps,
  tableAt,
  tableOf,
  textOf,
  type Table,
} from './file';
import { normalAngle, type Pose } from './geometry';
import type { Change, HandObject, Kept } from './hand';
import { tidy } from './snap';

export interface Keeping {
  steps: JsonStep[];
  /** What the file has not yet; by key how it has it then. */
  kept: Map<string, Kept>;
}

/** A place of the file and one of the run are the same, in m. */
const kNear = 0.001;
/** What the file need not say (docs/formats.md). */
const usual = { height: 0.1, mass: 0, colour: [0.9, 0.9, 0.9] };
const kSameColour = 0.005;

/** The smallest change of the file that keeps all changes; a thing that the file lacks is left out. */
export function keepSteps(file: Json, changes: readonly Change[]): Keeping {
  const keeping: Keeping = { steps: [], kept: new Map() };
  let value = file;
  for (const change of changes) {
    const { steps, id } = stepsFor(value, change);
    if (steps.length === 0) continue;
    keeping.steps.push(...steps);
    keeping.kept.set(change.key, { id, pose: change.to });
    value = applySteps(value, steps).value;
  }
  return keeping;
}

function stepsFor(file: Json, change: Change): { steps: JsonStep[]; id: string } {
  const { object, robot } = change;
  if (robot !== null)
    return { steps: movedSteps(file, keyOfRobot(file, robot), change), id: robot };
  if (!object) return { steps: [], id: '' };
  const key = keyOfObject(file, change);
  const known = key === null ? '' : textOf(tableAt(file, key)['id']);
  if (change.taken) return { steps: key === null ? [] : takenSteps(file, key), id: known };
  if (change.put && key === null) return putSteps(file, change, object);
  if (key === null) return { steps: [], id: '' };
  const steps = movedSteps(file, key, change);
  if (change.on === null) return { steps, id: known };
  const id = known || freeName(file, object.kind);
  return { steps: [...steps, ...lightSteps(file, key, id, change.on)], id };
}

function movedSteps(file: Json, key: string | null, { from, to, kept }: Change): JsonStep[] {
  if (key === null) return [];
  const moved = to.x !== from.x || to.y !== from.y || to.angle !== from.angle;
  if (!moved && !kept) return [];
  // A robot that has turned many times still looks that way: the angle of the file stays if it does.
  const written = numberOf(tableAt(file, key)['angle'], 0);
  const same = Math.abs(normalAngle(to.angle - written)) < kNear;
  return moveSteps(file, key, { ...to, angle: same ? written : normalAngle(to.angle) });
}

function putSteps(file: Json, { to, on }: Change, object: HandObject) {
  const id = freeName(file, object.id || object.kind);
  const { kind, size, radius, height, mass, colour } = object;
  const value: Table = { id, kind, at: [tidy(to.x), tidy(to.y)] };
  if (tidy(to.angle) !== 0) value['angle'] = tidy(normalAngle(to.angle));
  if (radius) value['radius'] = tidy(radius);
  else if (size) value['size'] = size.map(tidy);
  if (tidy(height) !== usual.height) value['height'] = tidy(height);
  if (mass !== usual.mass) value['mass'] = tidy(mass);
  if (colour.some((part, index) => Math.abs(part - (usual.colour[index] ?? 0)) > kSameColour))
    value['colour'] = colour.map(tidy);
  const { steps, key } = addSteps(file, 'objects', value);
  if (on !== false) return { steps, id };
  return { steps: [...steps, ...lightSteps(applySteps(file, steps).value, key, id, on)], id };
}

/** The object, and what the timeline would do with it; from the end, so that places stay. */
function takenSteps(file: Json, key: string): JsonStep[] {
  const part = partOfKey(key);
  const id = textOf(tableAt(file, key)['id']);
  const entries = listOf(tableOf(file), 'timeline').flatMap((one, index) => {
    const { id: of, object } = tableOf(one);
    const isOf = id !== '' && (of === id || tableOf(object)['id'] === id);
    return isOf || (part?.list === 'timeline' && part.index === index) ? [index] : [];
  });
  return [
    ...(part?.list === 'objects' ? removeSteps(file, key) : []),
    ...entries.reverse().flatMap((index) => removeSteps(file, keyOf({ list: 'timeline', index }))),
  ];
}

/** A lamp that is off is switched off at 0 s: its object has no member for that. */
function lightSteps(file: Json, key: string, id: string, on: boolean): JsonStep[] {
  const entries = listOf(tableOf(file), 'timeline');
  const index = entries.map(tableOf).findIndex((one) => isSwitchAtStart(one, id));
  if (on && index < 0) return [];
  if (on) return removeSteps(file, keyOf({ list: 'timeline', index }));
  const named = setSteps(file, key, 'id', id);
  if (index >= 0)
    return entries[index] && tableOf(entries[index])['on'] === false
      ? []
      : [...named, { do: 'set', at: ['timeline', index, 'on'], value: false }];
  const value: Table = { t: 0, do: 'light', id, on: false };
  return entries.length === 0
    ? [...named, ...addSteps(file, 'timeline', value).steps]
    : [...named, { do: 'insert', at: ['timeline', 0], value }];
}

function isSwitchAtStart(entry: Table, id: string): boolean {
  return entry['do'] === 'light' && entry['t'] === 0 && entry['id'] === id;
}

function keyOfRobot(file: Json, name: string): string | null {
  const index = listOf(tableOf(file), 'robots').findIndex((one) => tableOf(one)['name'] === name);
  return index < 0 ? null : keyOf({ list: 'robots', index });
}

/** By its name, or by its place; an object without either is the one of its number. */
function keyOfObject(file: Json, change: Change): string | null {
  const { object, kept, put } = change;
  const id = kept?.id || (object?.id ?? '');
  if (id !== '') return put && !kept ? null : keyOfId(file, id);
  if (put) return null;
  const objects = listOf(tableOf(file), 'objects').map(tableOf);
  const means = (one: Table | undefined) =>
    one !== undefined && textOf(one['id']) === '' && one['kind'] === object?.kind;
  const stands = objects.findIndex((one) => means(one) && isAt(one, kept?.pose ?? change.from));
  if (stands >= 0) return keyOf({ list: 'objects', index: stands });
  const index = change.number - 1;
  return means(objects[index]) ? keyOf({ list: 'objects', index }) : null;
}

function keyOfId(file: Json, id: string): string | null {
  const objects = listOf(tableOf(file), 'objects').map(tableOf);
  const index = objects.findIndex((one) => one['id'] === id);
  if (index >= 0) return keyOf({ list: 'objects', index });
  const entries = listOf(tableOf(file), 'timeline').map(tableOf);
  const later = entries.findIndex((one) => tableOf(one['object'])['id'] === id);
  return later < 0 ? null : keyOf({ list: 'timeline', index: later });
}

function isAt(table: Table, pose: Pose): boolean {
  const [x, y] = pairOf(table['at']) ?? [NaN, NaN];
  return Math.hypot(x - pose.x, y - pose.y) < kNear;
}
