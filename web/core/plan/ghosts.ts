// What a plan had before and has no more, placed so that it can be drawn with the plan as it is now:
// removed elements, and ways of arrows that are removed or led elsewhere.

import type { PlanDifference } from '../../protocol/messages';
import { drawingOf, isEvent, supervisorKey, type Arrow } from './arrows';
import { pillKey } from './board';
import { movedIn, removedIn } from './differences';
import type { Actor, Outcome, PlanModel, Supervisor, Variable } from './model';
import { kConfiguration, kStart, supervisorsOf } from './model';
import type { Routed } from './path';
import { freePlace, sceneOf, type Scene } from './place';
import { actorBlock, type Box } from './shape';

export interface Ghosts {
  /** Removed elements: actors, supervisors, variables. */
  elements: readonly { key: string; name: string; template: string; box: Box }[];
  arrows: readonly { id: string; route: Routed; isEvent: boolean; is: 'removed' | 'changed' }[];
}

interface Now {
  model: PlanModel;
  scene: Scene;
}

/** `before` as a model; isTime: the ways that are not found by then are left out. */
export function ghostsOf(
  differences: readonly PlanDifference[],
  before: PlanModel,
  now: Now,
  isTime: () => boolean = () => false,
): Ghosts {
  const removed = removedIn(differences);
  const moved = movedIn(differences);
  if (removed.size + moved.size === 0) return { elements: [], arrows: [] };
  const both = bothOf(removed, before, now);
  const scene = sceneOf(both);
  const { arrows, routes } = drawingOf(both, scene, { isTime });
  const wayOf = ({ id, source }: Arrow) => {
    const route = routes.get(id);
    const is = removed.has(id) ? 'removed' : moved.has(id) ? 'changed' : null;
    return route && is ? [{ id, route, isEvent: isEvent(source), is } as const] : [];
  };
  return { elements: elementsOf(removed, both, scene), arrows: arrows.flatMap(wayOf) };
}

/** Everything where it is now, what is removed beside it, arrows as they were. */
function bothOf(removed: ReadonlySet<string>, before: PlanModel, { model, scene }: Now): PlanModel {
  const goneActors = before.actors.filter(({ name }) => removed.has(name));
  const gone = (owner: string, now: readonly Supervisor[]) => {
    const there = new Map(supervisorsOf(before).map((one) => [supervisorKey(one), one]));
    const more = [...there.values()].filter(
      (one) => one.owner === owner && removed.has(supervisorKey(one)),
    );
    const left = now.map((one) => ({
      ...one,
      outcomes: outcomesOf(one.outcomes, there.get(supervisorKey(one))?.outcomes),
    }));
    return [...left, ...more];
  };
  const actors = model.actors.map((actor): Actor => {
    const was = before.actors.find(({ name }) => name === actor.name);
    return {
      ...actor,
      outcomes: outcomesOf(actor.outcomes, was?.outcomes),
      supervisors: gone(actor.name, actor.supervisors),
    };
  });
  const variables = before.variables.filter(({ name }) => removed.has(pillKey(name)));
  return {
    ...model,
    first: before.first,
    globals: gone(kStart, model.globals),
    actors: [...actors, ...goneActors],
    variables: [...model.variables, ...variables],
    places: placesOf(goneActors, before, scene),
  };
}

/** The rows of now, with the targets of before; below them those that are no more. */
function outcomesOf(now: readonly Outcome[], was: readonly Outcome[] = []): Outcome[] {
  const targets = new Map(was.map(({ name, target }) => [name, target]));
  const more = was.filter(({ name }) => !now.some((one) => one.name === name));
  return [...now.map((one) => ({ ...one, target: targets.get(one.name) ?? null })), ...more];
}

/** An element that is removed is where it was, or aside if something else is there now. */
function placesOf(
  goneActors: readonly Actor[],
  before: PlanModel,
  scene: Scene,
): PlanModel['places'] {
  const places = new Map<string, readonly [number, number]>();
  const { start, configuration, actors } = scene;
  for (const { name, box } of [start, ...actors]) places.set(name, [box.x, box.y]);
  places.set(kConfiguration, [configuration.x, configuration.y]);
  const then = new Map(sceneOf(before).actors.map((block) => [block.name, block]));
  let taken = scene;
  for (const actor of goneActors) {
    const block = then.get(actor.name);
    if (!block) continue;
    const { width, height } = block.whole;
    const at = freePlace(taken, block.box, { width, height });
    places.set(actor.name, [at.x, at.y]);
    taken = { ...taken, actors: [...taken.actors, actorBlock(actor, at)] };
  }
  return places;
}

function elementsOf(
  removed: ReadonlySet<string>,
  both: PlanModel,
  scene: Scene,
): Ghosts['elements'] {
  const boxes = new Map<string, Box>();
  for (const block of [scene.start, ...scene.actors]) {
    boxes.set(block.name, block.box);
    for (const { supervisor, box } of block.supervisors) boxes.set(supervisorKey(supervisor), box);
  }
  for (const { name, box } of scene.pills) boxes.set(pillKey(name), box);
  const drawn = (key: string, name: string, template: string) => {
    const box = boxes.get(key);
    return removed.has(key) && box ? [{ key, name, template, box }] : [];
  };
  return [
    ...both.actors.flatMap(({ name, template }) => drawn(name, name, template)),
    ...supervisorsOf(both).flatMap((one) => drawn(supervisorKey(one), one.name, one.template)),
    ...both.variables.flatMap(({ name, type }: Variable) => drawn(pillKey(name), name, type)),
  ];
}
