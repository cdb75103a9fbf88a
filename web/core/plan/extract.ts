// Chosen actors become a plan of their own, with one actor in their place. What the plan does stays
// the same: where that cannot be, the reason is given.

import type { Json, JsonStep } from '../../protocol/messages';
import { namesIn } from './data';
import { freeName } from './edit';
import { listOf, memberOf, tableOf, textOf, type Table } from './json';
import { kTerminate, supervisorsOf, type Actor, type PlanModel, type Supervisor } from './model';
import { Draft } from './part';
import type { Point } from './shape';

export type WhyNot =
  | { why: 'entries'; names: string[] }
  | { why: 'states'; names: string[] }
  | { why: 'events'; names: string[] }
  | { why: 'interrupted'; names: string[] };

export interface Extracted {
  /** Members of the new plan's file. */
  file: Table;
  /** What becomes of the plan that it was taken from. */
  steps: JsonStep[];
  /** The actor that stands for the new plan. */
  name: string;
}

interface Exit {
  from: string;
  target: string;
  isState: boolean;
}

export function extract(
  file: Json,
  model: PlanModel,
  chosen: ReadonlySet<string>,
  made: { name: string; path: string; placeOf: (actor: string) => Point },
): Extracted | WhyNot {
  const inside = model.actors.filter((one) => chosen.has(one.name));
  const entries = entriesOf(model, chosen);
  const [entry] = entries;
  if (entry === undefined || entries.length > 1) return { why: 'entries', names: entries };
  const exits = inside.flatMap((actor) => exitsOf(actor, chosen));
  const states = targets(exits, true);
  const events = targets(exits, false);
  if (states.length > 1) return { why: 'states', names: states };
  // A plan that an event ends is interrupted; one that goes on from a state of an actor is not.
  if (events.includes(kTerminate))
    return {
      why: 'interrupted',
      names: exits.filter((one) => one.target === kTerminate).map((one) => one.from),
    };
  if (events.length > 1) return { why: 'events', names: events };
  return {
    name: entry,
    file: innerFile(file, inside, { chosen, entry, ...made }),
    steps: outerSteps(file, model, {
      chosen,
      entry,
      path: made.path,
      at: made.placeOf(entry),
      next: { OK: states[0] ?? kTerminate, Interrupted: events[0] ?? kTerminate },
    }),
  };
}

/** The actors inside to which something outside leads. */
function entriesOf(model: PlanModel, chosen: ReadonlySet<string>): string[] {
  const outside = [
    ...model.actors.filter((one) => !chosen.has(one.name)),
    ...supervisorsOf(model).filter((one) => !chosen.has(one.owner)),
  ];
  const led = outside.flatMap((one) => one.outcomes.flatMap(({ target }) => target ?? []));
  const all = model.first === null ? led : [model.first, ...led];
  return [...new Set(all.filter((name) => chosen.has(name)))];
}

function exitsOf(actor: Actor, chosen: ReadonlySet<string>): Exit[] {
  return [actor, ...actor.supervisors].flatMap((one: Actor | Supervisor) =>
    one.outcomes.flatMap(({ target }) =>
      target === null || chosen.has(target) || target === '@ignore'
        ? []
        : [{ from: one.name, target, isState: !('owner' in one) }],
    ),
  );
}

function targets(exits: readonly Exit[], isState: boolean): string[] {
  return [...new Set(exits.filter((one) => one.isState === isState).map((one) => one.target))];
}

interface Inner {
  chosen: ReadonlySet<string>;
  entry: string;
  name: string;
  placeOf: (actor: string) => Point;
}

function innerFile(file: Json, inside: readonly Actor[], how: Inner): Table {
  const elements = [...inside, ...inside.flatMap((one) => one.supervisors)];
  const used = new Set(
    elements.flatMap((one) => [
      ...Object.values(one.inputs).flatMap((formula) => [...namesIn(textOf(formula))]),
      ...Object.values(one.outputs).map(textOf),
    ]),
  );
  const actors = tableOf(memberOf(file, 'actors'));
  const toolboxes = listOf(memberOf(file, 'toolboxes'));
  const shared = Object.entries(tableOf(memberOf(file, 'configuration')))
    .filter(([name]) => used.has(name))
    .map(([name, one]): [string, Json] => [name, sharedVariable(one)]);
  const kept = (target: string) => (how.chosen.has(target) ? target : kTerminate);
  return {
    name: how.name,
    ...(toolboxes.length > 0 ? { toolboxes: [...toolboxes] } : {}),
    ...(shared.length > 0 ? { configuration: Object.fromEntries(shared) } : {}),
    start: { actor: how.entry },
    actors: Object.fromEntries(
      inside.map(({ name }) => [name, ledInside(actors[name] ?? {}, kept)]),
    ),
    layout: Object.fromEntries(
      inside.map(({ name }) => [name, [how.placeOf(name).x, how.placeOf(name).y]]),
    ),
  };
}

/** The caller's own (P5): what it begins with is said there. */
function sharedVariable(variable: Json): Json {
  const { type, unit, help } = tableOf(variable);
  return {
    ...(type === undefined ? {} : { type }),
    access: 'shared',
    ...(unit === undefined ? {} : { unit }),
    ...(help === undefined ? {} : { help }),
  };
}

function ledInside(actor: Json, kept: (target: string) => string): Json {
  const led = ledTable(actor, 'states', kept);
  const supervisors = Object.entries(tableOf(memberOf(actor, 'supervisors')));
  if (supervisors.length === 0) return led;
  return {
    ...tableOf(led),
    supervisors: Object.fromEntries(
      supervisors.map(([name, one]) => [name, ledTable(one, 'events', kept)]),
    ),
  };
}

function ledTable(value: Json, member: string, kept: (target: string) => string): Json {
  const arrows = Object.entries(tableOf(memberOf(value, member)));
  if (arrows.length === 0) return value;
  const led = arrows.map(([name, target]): [string, Json] => [
    name,
    typeof target === 'string' && !target.startsWith('@ignore') ? kept(target) : target,
  ]);
  return { ...tableOf(value), [member]: Object.fromEntries(led) };
}

interface Outer {
  chosen: ReadonlySet<string>;
  entry: string;
  path: string;
  at: Point;
  next: { OK: string; Interrupted: string };
}

/** An error inside was one of the plan; it stays one: an actor that fails comes after it. */
function outerSteps(file: Json, model: PlanModel, how: Outer): JsonStep[] {
  const draft = new Draft(file);
  const failed = freeName(model, `${how.entry}Failed`);
  for (const name of how.chosen) {
    draft.drop(['actors', name]);
    draft.drop(['layout', name]);
  }
  const text = (word: string) => `"${word}"`;
  draft.set(['actors', how.entry], {
    plan: how.path,
    states: { ...how.next, Error: failed },
  });
  draft.set(['actors', failed], {
    template: 'Fail',
    in: { message: text(`an error in the sub-plan ${how.entry}`) },
  });
  draft.set(['layout', how.entry], [how.at.x, how.at.y]);
  return draft.steps;
}

export function isExtracted(made: Extracted | WhyNot): made is Extracted {
  return 'steps' in made;
}
