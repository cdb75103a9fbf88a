// How things and places are said.

import { degrees, normalAngle, type Pose } from '../../../core/world/geometry';
import type { WorldModel } from '../../../core/world/model';
import type { Thing } from '../../../core/world/stage';
import { text } from '../../text';

const words = text.world;

/** Its name, or what it is with the number that it has in the list or in the run. */
export function nameOfThing(thing: Thing): string {
  if (thing.name !== '') return thing.name;
  const number = thing.key.replace(/^\D*/, '');
  const shown = thing.key.includes('/') ? String(Number(number) + 1) : number;
  return words.unnamed(words.kinds[thing.kind], shown);
}

export function metres(value: number): string {
  return value.toFixed(2);
}

export function degreesText(angle: number): string {
  return degrees(normalAngle(angle)).toFixed(0).replace(/^-0$/, '0');
}

export function placeText(pose: Pose): string {
  return Number.isFinite(pose.x)
    ? words.placeText(metres(pose.x), metres(pose.y), degreesText(pose.angle))
    : words.nobody;
}

/** "carbot: 0.80, 1.90 m, -63°", for those who listen. */
export function spokenPlace(model: WorldModel, thing: Thing): string {
  return words.moved(nameOfThing(thing), placeText(model.poseOf(thing)));
}

/** What a command needs first. */
export const worldNeeds = {
  open: 'Open a world first.',
  edit: 'Open the file of a world and choose Edit first.',
  select: 'Select a thing in the world first.',
  robotStays: 'A robot cannot be taken out of a run. Choose Edit to delete it from the file.',
};
