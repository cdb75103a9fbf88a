// Edits of a plan as steps on its file. Only what is meant is touched; what the drawing does not
// know stays where it is.

import type { Json, JsonStep } from '../../protocol/messages';
import { memberOf, listOf, tableOf, textOf } from './json';
import {
  kStart,
  supervisorsOf,
  type Actor,
  type Keys,
  type PlanModel,
  type Supervisor,
} from './model';
import type { Point } from './shape';
import type { Found } from './templates';

export interface Added {
  steps: JsonStep[];
  name: string;
}

const set = (at: Json[], value: Json): JsonStep => ({ do: 'set', at, value });
const remove = (at: Json[]): JsonStep => ({ do: 'remove', at });

export function valueAt(file: Json, keys: readonly string[]): Json | undefined {
  return keys.reduce<Json | undefined>((value, key) => memberOf(value, key), file);
}

/** Sets a member; the objects on the way are made where they are missing. */
export function setSteps(file: Json, keys: Keys, value: Json): JsonStep[] {
  for (let depth = 1; depth < keys.length; depth++) {
    if (valueAt(file, keys.slice(0, depth)) !== undefined) continue;
    const inner = keys.slice(depth).reduceRight<Json>((made, key) => ({ [key]: made }), value);
    return [set(keys.slice(0, depth), inner)];
  }
  return [set([...keys], value)];
}

/** Removes a member, if there is one. */
export function dropSteps(file: Json, keys: Keys): JsonStep[] {
  return valueAt(file, keys) === undefined ? [] : [remove([...keys])];
}

export function placeSteps(file: Json, name: string, { x, y }: Point): JsonStep[] {
  return setSteps(file, ['layout', name], [x, y]);
}

/** Keys of where a state or event leads. */
function targetKeys(source: Actor | Supervisor, outcome: string): Keys {
  return [...source.keys, 'owner' in source ? 'events' : 'states', outcome];
}

export function connectSteps(
  file: Json,
  source: Actor | Supervisor | typeof kStart,
  outcome: string,
  target: string | null,
): JsonStep[] {
  const keys = source === kStart ? ['start', 'actor'] : targetKeys(source, outcome);
  return target === null ? dropSteps(file, keys) : setSteps(file, keys, target);
}

// ---- adding ----

/** A name that nothing in the plan has, nor one of more. */
export function freeName(
  model: PlanModel,
  wanted: string,
  more: ReadonlySet<string> = new Set(),
): string {
  const all = [...model.actors, ...supervisorsOf(model), ...model.variables];
  const taken = new Set([...all.map((one) => one.name), ...more]);
  const bare = wanted.replace(/\d*$/, '').replace(/\W/g, '') || 'element';
  const base = /^\d/.test(bare) ? `_${bare}` : bare[0]?.toLowerCase() + bare.slice(1);
  if (!taken.has(base)) return base;
  for (let number = 2; ; number++) if (!taken.has(base + number)) return base + number;
}

const kCore = 'core';

function listSteps(file: Json, toolbox: string): JsonStep[] {
  const listed = listOf(memberOf(file, 'toolboxes')).map(textOf);
  if (toolbox === kCore || listed.includes(toolbox)) return [];
  return setSteps(file, ['toolboxes'], [...listed, toolbox]);
}

export function addActor(file: Json, model: PlanModel, found: Found, at: Point): Added {
  const name = freeName(model, found.template.name);
  const first = model.first === null ? setSteps(file, ['start', 'actor'], name) : [];
  return {
    name,
    steps: [
      ...listSteps(file, found.toolbox),
      ...first,
      ...setSteps(file, ['actors', name], { template: found.template.name }),
      ...placeSteps(file, name, at),
    ],
  };
}

export function addSubPlan(file: Json, model: PlanModel, path: string, at: Point): Added {
  const name = freeName(model, path.replace(/^.*\//, '').replace(/\.plan\.json$/, ''));
  const first = model.first === null ? setSteps(file, ['start', 'actor'], name) : [];
  return {
    name,
    steps: [
      ...first,
      ...setSteps(file, ['actors', name], { plan: path }),
      ...placeSteps(file, name, at),
    ],
  };
}

export function addSupervisor(file: Json, model: PlanModel, found: Found, owner: string): Added {
  const name = freeName(model, found.template.name);
  const keys = owner === kStart ? ['start'] : ['actors', owner];
  const value = { template: found.template.name };
  return {
    name,
    steps: [
      ...listSteps(file, found.toolbox),
      ...setSteps(file, [...keys, 'supervisors', name], value),
    ],
  };
}

export function addVariable(file: Json, model: PlanModel): Added {
  const name = freeName(model, 'value');
  return {
    name,
    steps: setSteps(file, ['configuration', name], { type: 'float', initial: 0 }),
  };
}

// ---- removing ----

export function removeActor(file: Json, model: PlanModel, name: string): JsonStep[] {
  const kept = [
    ...model.actors.filter((one) => one.name !== name),
    ...supervisorsOf(model).filter((one) => one.owner !== name),
  ];
  const arrows = kept.flatMap((source) =>
    source.outcomes
      .filter((one) => one.target === name)
      .map((one) => remove([...targetKeys(source, one.name)])),
  );
  const first = model.first === name ? dropSteps(file, ['start', 'actor']) : [];
  return [
    ...arrows,
    ...first,
    ...dropSteps(file, ['layout', name]),
    ...dropSteps(file, ['actors', name]),
  ];
}

// ---- renaming ----

export function renameActor(file: Json, model: PlanModel, from: string, to: string): JsonStep[] {
  const now = (keys: Keys): Keys =>
    keys[0] === 'actors' && keys[1] === from ? ['actors', to, ...keys.slice(2)] : keys;
  const arrows = [...model.actors, ...supervisorsOf(model)].flatMap((source) =>
    source.outcomes
      .filter((one) => one.target === from)
      .map((one) => set([...now(targetKeys(source, one.name))], to)),
  );
  return [
    ...renamedKey(file, ['actors'], from, to),
    ...renamedKey(file, ['layout'], from, to),
    ...(model.first === from ? [set(['start', 'actor'], to)] : []),
    ...arrows,
  ];
}

/** Another key for the same value, at the same place among its brothers. */
export function renamedKey(file: Json, keys: Keys, from: string, to: string): JsonStep[] {
  const holder = tableOf(valueAt(file, keys));
  const value = holder[from];
  if (value === undefined) return [];
  const index = Object.keys(holder).indexOf(from);
  return [
    set([...keys, to], value),
    remove([...keys, from]),
    { do: 'move', at: [...keys, to], to: index },
  ];
}

export function renameVariable(file: Json, model: PlanModel, from: string, to: string): JsonStep[] {
  const elements = [...model.actors, ...supervisorsOf(model)];
  const uses = elements.flatMap((one) => [
    ...Object.entries(one.inputs)
      .filter(([, formula]) => renamedIn(textOf(formula), from, to) !== textOf(formula))
      .map(([name, formula]) =>
        set([...one.keys, 'in', name], renamedIn(textOf(formula), from, to)),
      ),
    ...Object.entries(one.outputs)
      .filter(([, variable]) => variable === from)
      .map(([name]) => set([...one.keys, 'out', name], to)),
  ]);
  return [...uses, ...renamedKey(file, ['configuration'], from, to)];
}

/** A formula with another name for a variable; texts and functions stay. */
export function renamedIn(formula: string, from: string, to: string): string {
  const parts = formula.split(/("[^"]*"|'[^']*')/);
  const word = new RegExp(`(?<![\\w.])${from}(?!\\w|\\s*\\()`, 'g');
  return parts.map((part, index) => (index % 2 === 0 ? part.replace(word, to) : part)).join('');
}

const kName = /^[A-Za-z_]\w*$/;
const kReserved = ['true', 'false', 'and', 'or', 'not'];

/** Why a text cannot be the name of something in a plan (P1), or null. */
export function whyNoName(
  model: PlanModel,
  name: string,
  is: 'actor' | 'supervisor' | 'variable',
): 'form' | 'taken' | null {
  if (!kName.test(name) || (is === 'variable' && kReserved.includes(name))) return 'form';
  const all = { actor: model.actors, supervisor: supervisorsOf(model), variable: model.variables };
  return all[is].some((one) => one.name === name) ? 'taken' : null;
}

// ---- values ----

/** A formula as a file writes it: a number or truth value as itself. */
export function formulaJson(typed: string): Json {
  const text = typed.trim();
  if (text === 'true' || text === 'false') return text === 'true';
  if (/^-?(0|[1-9]\d{0,14})(\.\d{0,9}[1-9])?$/.test(text)) return Number(text);
  return typed;
}

export function shownFormula(value: Json | undefined): string {
  if (value === undefined || value === null) return '';
  return typeof value === 'string' ? value : JSON.stringify(value);
}

/** An input gets a formula; an empty one is no longer fed. */
export function feedSteps(file: Json, keys: Keys, input: string, typed: string): JsonStep[] {
  const at = [...keys, 'in', input];
  return typed.trim() === '' ? dropSteps(file, at) : setSteps(file, at, formulaJson(typed));
}

/** An output goes to a variable; '' drops it. */
export function keepSteps(file: Json, keys: Keys, output: string, variable: string): JsonStep[] {
  const at = [...keys, 'out', output];
  return variable === '' ? dropSteps(file, at) : setSteps(file, at, variable);
}
