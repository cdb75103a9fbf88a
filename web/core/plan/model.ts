// A plan file as a drawing needs it. Nothing of the file is kept here that the drawing does not
// show: edits are steps on the file itself (edit.ts), so nothing is lost.

import type { Json, PlanTemplate } from '../../protocol/messages';
import { listOf, memberOf, tableOf, textOf, type Table } from './json';
import { findTemplate, type Toolboxes } from './templates';

export const kStart = '@start';
export const kConfiguration = '@configuration';
export const kTerminate = '@terminate';
export const kIgnore = '@ignore';

/** Keys of the JSON file that lead to something. */
export type Keys = readonly string[];

/** A state of an actor, an event of a supervisor. */
export interface Outcome {
  name: string;
  /** Where it leads: an actor, @terminate, @ignore; null: nowhere yet. */
  target: string | null;
  help: string;
}

interface Element {
  name: string;
  template: string;
  toolbox: string;
  known: PlanTemplate | undefined;
  keys: Keys;
  inputs: Table;
  outputs: Table;
  outcomes: readonly Outcome[];
}

export interface Supervisor extends Element {
  /** The actor it is attached to, or @start. */
  owner: string;
}

export interface Actor extends Element {
  role: 'actor' | 'computation' | 'subplan';
  supervisors: readonly Supervisor[];
}

export interface Variable {
  name: string;
  type: string;
  unit: string;
  initial: string;
}

export interface Note {
  /** In the list of the file. */
  index: number;
  text: string;
  at: readonly [number, number];
  size: readonly [number, number];
}

export interface PlanModel {
  name: string;
  toolboxes: readonly string[];
  /** The first actor; null: none is named. */
  first: string | null;
  globals: readonly Supervisor[];
  actors: readonly Actor[];
  variables: readonly Variable[];
  places: ReadonlyMap<string, readonly [number, number]>;
  notes: readonly Note[];
}

const kSubPlanStates = ['OK', 'Interrupted', 'Error'];

export function planModel(file: Json, toolboxes: Toolboxes): PlanModel {
  const listed = listOf(memberOf(file, 'toolboxes')).map(textOf);
  const start = memberOf(file, 'start');
  const supervisors = (owner: string, from: Json | undefined, keys: Keys) =>
    Object.entries(tableOf(memberOf(from, 'supervisors'))).map(([name, value]) =>
      supervisorOf(owner, name, value, [...keys, 'supervisors', name], toolboxes, listed),
    );
  return {
    name: textOf(memberOf(file, 'name')),
    toolboxes: listed,
    first: textOf(memberOf(start, 'actor')) || null,
    globals: supervisors(kStart, start, ['start']),
    actors: Object.entries(tableOf(memberOf(file, 'actors'))).map(([name, value]) => ({
      ...actorOf(name, value, toolboxes, listed),
      supervisors: supervisors(name, value, ['actors', name]),
    })),
    variables: Object.entries(tableOf(memberOf(file, 'configuration'))).map(([name, value]) => ({
      name,
      type: textOf(memberOf(value, 'type')),
      unit: textOf(memberOf(value, 'unit')),
      initial: shownConstant(memberOf(value, 'initial')),
    })),
    places: placesOf(memberOf(file, 'layout')),
    notes: notesOf(memberOf(memberOf(file, 'x'), 'notes')),
  };
}

function actorOf(name: string, value: Json, toolboxes: Toolboxes, listed: readonly string[]) {
  const plan = memberOf(value, 'plan');
  const template = textOf(plan) || textOf(memberOf(value, 'template'));
  const found = plan === undefined ? findTemplate(toolboxes, listed, template, false) : undefined;
  const declared = plan === undefined ? outcomesOf(found?.template) : subPlanStates();
  const isComputation = found?.template.kind === 'computation';
  const role: Actor['role'] =
    plan !== undefined ? 'subplan' : isComputation ? 'computation' : 'actor';
  return {
    name,
    role,
    template,
    toolbox: found?.toolbox ?? '',
    known: found?.template,
    keys: ['actors', name],
    inputs: tableOf(memberOf(value, 'in')),
    outputs: tableOf(memberOf(value, 'out')),
    outcomes: led(declared, tableOf(memberOf(value, 'states'))),
  };
}

function supervisorOf(
  owner: string,
  name: string,
  value: Json,
  keys: Keys,
  toolboxes: Toolboxes,
  listed: readonly string[],
): Supervisor {
  const template = textOf(memberOf(value, 'template'));
  const found = findTemplate(toolboxes, listed, template, true);
  return {
    owner,
    name,
    template,
    toolbox: found?.toolbox ?? '',
    known: found?.template,
    keys,
    inputs: tableOf(memberOf(value, 'in')),
    outputs: tableOf(memberOf(value, 'out')),
    outcomes: led(outcomesOf(found?.template), tableOf(memberOf(value, 'events'))),
  };
}

type Declared = readonly { name: string; help: string }[];

function outcomesOf(template: PlanTemplate | undefined): Declared {
  return template?.outcomes ?? [];
}

function subPlanStates(): Declared {
  return kSubPlanStates.map((name) => ({ name, help: '' }));
}

/** What is declared, in its order, then what only the file names. */
function led(declared: Declared, targets: Table): Outcome[] {
  const target = (name: string) => textOf(targets[name]) || null;
  const known = declared.map(({ name, help }) => ({ name, help, target: target(name) }));
  const more = Object.keys(targets).filter((name) => !declared.some((one) => one.name === name));
  return [...known, ...more.map((name) => ({ name, help: '', target: target(name) }))];
}

function placesOf(layout: Json | undefined): Map<string, readonly [number, number]> {
  const places = new Map<string, readonly [number, number]>();
  for (const [name, value] of Object.entries(tableOf(layout))) {
    const at = pairOf(value);
    if (at) places.set(name, at);
  }
  return places;
}

function pairOf(value: Json | undefined): readonly [number, number] | null {
  const [x, y] = listOf(value);
  return typeof x === 'number' && typeof y === 'number' ? [x, y] : null;
}

function notesOf(value: Json | undefined): Note[] {
  return listOf(value).flatMap((one, index) => {
    const at = pairOf(memberOf(one, 'at'));
    const size = pairOf(memberOf(one, 'size'));
    return at && size ? [{ index, at, size, text: textOf(memberOf(one, 'text')) }] : [];
  });
}

function shownConstant(value: Json | undefined): string {
  if (value === undefined || value === null || typeof value === 'object') return '';
  return typeof value === 'string' ? `"${value}"` : String(value);
}

export function supervisorsOf(model: PlanModel): readonly Supervisor[] {
  return [...model.globals, ...model.actors.flatMap((actor) => actor.supervisors)];
}

/** The actor or supervisor of that name; an actor first, as the checker names them. */
export function elementOf(model: PlanModel, name: string): Actor | Supervisor | undefined {
  return (
    model.actors.find((one) => one.name === name) ??
    supervisorsOf(model).find((one) => one.name === name)
  );
}

/** Actors first, then what ends or ignores: what a state or event may lead to. */
export function targetsFor(model: PlanModel, source: Actor | Supervisor): string[] {
  const ends = 'owner' in source ? [kTerminate, kIgnore] : [kTerminate];
  return [...model.actors.map((one) => one.name), ...ends];
}
