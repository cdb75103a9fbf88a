// A part of a plan as text: what is copied, pasted into this or another plan, and duplicated. It is
// JSON with the members of a plan file, so that a person can read it anywhere.

import type { Json, JsonStep } from '../../protocol/messages';
import { applySteps } from '../json_steps';
import { namesIn } from './data';
import { dropSteps, freeName, setSteps } from './edit';
import { listOf, memberOf, tableOf, textOf, type Table } from './json';
import { kStart, supervisorsOf, type Actor, type PlanModel, type Supervisor } from './model';
import type { Point } from './shape';

export const kPartFormat = 'vagus-plan-part/1';

export interface Part {
  toolboxes: readonly string[];
  configuration: Table;
  actors: Table;
  /** Supervisors that were copied without the actor that they are attached to. */
  supervisors: Table;
  layout: ReadonlyMap<string, Point>;
}

/** The chosen actors with their supervisors, chosen supervisors, and the variables that they use. */
export function partOf(
  file: Json,
  model: PlanModel,
  chosen: { actors: ReadonlySet<string>; supervisors: readonly Supervisor[] },
  placeOf: (actor: string) => Point,
): Part | null {
  const actors = model.actors.filter((one) => chosen.actors.has(one.name));
  const alone = chosen.supervisors.filter((one) => !chosen.actors.has(one.owner));
  if (actors.length + alone.length === 0) return null;
  const elements = [...actors, ...actors.flatMap((one) => one.supervisors), ...alone];
  const used = usedNames(elements);
  const toolboxes = new Set(elements.map((one) => one.toolbox));
  const configuration = tableOf(memberOf(file, 'configuration'));
  return {
    toolboxes: model.toolboxes.filter((name) => toolboxes.has(name)),
    configuration: onlyOf(configuration, (name) => used.has(name)),
    actors: onlyOf(tableOf(memberOf(file, 'actors')), (name) => chosen.actors.has(name)),
    supervisors: Object.fromEntries(alone.map((one) => [one.name, at(file, one.keys)])),
    layout: new Map(actors.map((one) => [one.name, placeOf(one.name)])),
  };
}

function usedNames(elements: readonly (Actor | Supervisor)[]): Set<string> {
  const formulas = elements.flatMap((one) => Object.values(one.inputs).map(textOf));
  const outputs = elements.flatMap((one) => Object.values(one.outputs).map(textOf));
  return new Set([...formulas.flatMap((one) => [...namesIn(one)]), ...outputs]);
}

function onlyOf(table: Table, wanted: (name: string) => boolean): Table {
  return Object.fromEntries(Object.entries(table).filter(([name]) => wanted(name)));
}

function at(file: Json, keys: readonly string[]): Json {
  return keys.reduce<Json>((value, key) => memberOf(value, key) ?? {}, file);
}

// ---- as text ----

export function partText(part: Part): string {
  const { toolboxes, configuration, actors, supervisors, layout } = part;
  const places = [...layout].map(([name, { x, y }]): [string, Json] => [name, [x, y]]);
  const whole = {
    format: kPartFormat,
    ...(toolboxes.length > 0 ? { toolboxes: [...toolboxes] } : {}),
    ...named({ configuration, actors, supervisors, layout: Object.fromEntries(places) }),
  };
  return `${JSON.stringify(whole, null, 2)}\n`;
}

function named(tables: Record<string, Table>): Table {
  return onlyOf(tables, (name) => Object.keys(tables[name] ?? {}).length > 0);
}

/** Longer texts are not looked at. */
export const kPartMax = 1_000_000;

/** null: the text is something else. */
export function parsePart(text: string): Part | null {
  if (text.length > kPartMax || !text.includes(kPartFormat)) return null;
  const value = parsed(text);
  if (memberOf(value, 'format') !== kPartFormat) return null;
  const layout = Object.entries(tableOf(memberOf(value, 'layout'))).flatMap(
    ([name, place]): [string, Point][] => {
      const [x, y] = listOf(place);
      return typeof x === 'number' && typeof y === 'number' ? [[name, { x, y }]] : [];
    },
  );
  return {
    toolboxes: listOf(memberOf(value, 'toolboxes')).map(textOf).filter(Boolean),
    configuration: tables(memberOf(value, 'configuration')),
    actors: tables(memberOf(value, 'actors')),
    supervisors: tables(memberOf(value, 'supervisors')),
    layout: new Map(layout),
  };
}

/** Members that are objects themselves; what else a person wrote there is left out. */
function tables(value: Json | undefined): Table {
  const all = Object.entries(tableOf(value));
  return Object.fromEntries(
    all.filter(([, one]) => typeof one === 'object' && one !== null && !Array.isArray(one)),
  );
}

function parsed(text: string): Json | undefined {
  try {
    return JSON.parse(text) as Json;
  } catch {
    return undefined;
  }
}

// ---- pasting ----

export interface Pasted {
  steps: JsonStep[];
  /** Actors by their new names, and supervisors without an actor of theirs. */
  actors: string[];
  supervisors: string[];
}

/**
 * The steps that put a part into a plan, its upper left corner at a point; lone supervisors under
 * `owner`. Elements whose name is taken get another one; variables that are there are used as they
 * are. Arrows to what neither the part nor the plan has lead nowhere.
 */
export function paste(
  file: Json,
  model: PlanModel,
  part: Part,
  to: { at: Point; owner: string },
): Pasted {
  const draft = new Draft(file);
  const names = freeNames(model, part);
  listToolboxes(draft, part.toolboxes);
  for (const [name, value] of Object.entries(part.configuration))
    if (!model.variables.some((one) => one.name === name))
      draft.set(['configuration', name], value);
  const known = (target: string) =>
    names.actors.get(target) ?? (isTarget(model, target) ? target : null);
  for (const [name, value] of Object.entries(part.actors)) {
    const free = names.actors.get(name) ?? name;
    draft.set(['actors', free], renamedActor(value, names.supervisors, known));
  }
  for (const [name, { x, y }] of placesFrom(part, to.at))
    draft.set(['layout', names.actors.get(name) ?? name], [x, y]);
  const holder = to.owner === kStart ? ['start'] : ['actors', to.owner];
  for (const [name, value] of Object.entries(part.supervisors)) {
    const free = names.supervisors.get(name) ?? name;
    draft.set([...holder, 'supervisors', free], renamedArrows(value, 'events', known));
  }
  return {
    steps: draft.steps,
    actors: [...names.actors.values()],
    supervisors: Object.keys(part.supervisors).map((name) => names.supervisors.get(name) ?? name),
  };
}

/** Several changes, each on what those before it have left. */
export class Draft {
  readonly steps: JsonStep[] = [];

  constructor(public file: Json) {}

  set(keys: readonly string[], value: Json): void {
    this.do(setSteps(this.file, keys, value));
  }

  drop(keys: readonly string[]): void {
    this.do(dropSteps(this.file, keys));
  }

  do(steps: JsonStep[]): void {
    this.file = applySteps(this.file, steps).value;
    this.steps.push(...steps);
  }
}

function listToolboxes(draft: Draft, wanted: readonly string[]): void {
  const listed = listOf(memberOf(draft.file, 'toolboxes')).map(textOf);
  const missing = wanted.filter((name) => !listed.includes(name));
  if (missing.length > 0) draft.set(['toolboxes'], [...listed, ...missing]);
}

function isTarget(model: PlanModel, name: string): boolean {
  return name.startsWith('@') || model.actors.some((one) => one.name === name);
}

interface Names {
  actors: ReadonlyMap<string, string>;
  supervisors: ReadonlyMap<string, string>;
}

/** Names stay where nothing has them yet. */
function freeNames(model: PlanModel, part: Part): Names {
  const all = [...model.actors, ...supervisorsOf(model), ...model.variables];
  const taken = new Set([...all.map((one) => one.name), ...Object.keys(part.configuration)]);
  const free = (name: string): [string, string] => {
    const found = taken.has(name) ? freeName(model, name, taken) : name;
    taken.add(found);
    return [name, found];
  };
  const actors = new Map(Object.keys(part.actors).map(free));
  const hanging = Object.values(part.actors).flatMap((one) =>
    Object.keys(tableOf(memberOf(one, 'supervisors'))),
  );
  return {
    actors,
    supervisors: new Map([...hanging, ...Object.keys(part.supervisors)].map(free)),
  };
}

type Known = (target: string) => string | null;

function renamedActor(value: Json, names: ReadonlyMap<string, string>, known: Known): Json {
  const own = Object.entries(tableOf(memberOf(value, 'supervisors')));
  const supervisors = own.map(([name, one]): [string, Json] => [
    names.get(name) ?? name,
    renamedArrows(one, 'events', known),
  ]);
  const led = renamedArrows(value, 'states', known);
  if (own.length === 0) return led;
  return { ...tableOf(led), supervisors: Object.fromEntries(supervisors) };
}

function renamedArrows(value: Json, member: 'states' | 'events', known: Known): Json {
  const arrows = memberOf(value, member);
  if (arrows === undefined) return value;
  const led = Object.entries(tableOf(arrows)).flatMap(([outcome, target]): [string, Json][] => {
    const to = typeof target === 'string' ? known(target) : target;
    return to === null ? [] : [[outcome, to]];
  });
  return { ...tableOf(value), [member]: Object.fromEntries(led) };
}

function placesFrom(part: Part, at: Point): [string, Point][] {
  const places = [...part.layout].filter(([name]) => Object.hasOwn(part.actors, name));
  const left = Math.min(...places.map(([, { x }]) => x));
  const top = Math.min(...places.map(([, { y }]) => y));
  return places.map(([name, { x, y }]) => [name, { x: at.x + x - left, y: at.y + y - top }]);
}
