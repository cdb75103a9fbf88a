// What commands look at: the last values of the topics that the window always follows.

import type { Doc, Json, Node } from '../../protocol/messages';
import { kLastPlan } from '../../core/run_choice';
import type { Studio } from '../../core/studio';

export const projectOf = (studio: Studio) => studio.topics.get('studio', {})?.project ?? null;
export const robotOf = (studio: Studio) => studio.topics.get('robot', {});
export const clockOf = (studio: Studio) => studio.topics.get('clock', {});

export function drives(studio: Studio): boolean {
  return studio.drives;
}

/** May change what runs: at an instant of the past nothing does. Stop is for now, always. */
export function mayAct(studio: Studio): boolean {
  return drives(studio) && studio.past.at === null;
}

/** May open another project: a robot that serves itself has one. */
export function mayLeave(studio: Studio): boolean {
  return drives(studio) && !studio.topics.get('studio', {})?.serves;
}

/** The node whose script is looked at. */
export function shownNode(studio: Studio): Node | undefined {
  const { doc } = studio.window.getState();
  return doc === null ? undefined : robotOf(studio)?.nodes.find((node) => node.doc === doc);
}

/** Keeps a part of the window; a page that may only view has it until it is closed, as has the start screen. */
export function keepState(studio: Studio, key: string, value: Json): void {
  if (drives(studio) && projectOf(studio)) studio.order('state.put', { key, value });
}

/** F5 from anywhere but a plan starts it again. */
export function rememberPlan(studio: Studio, doc: Doc | undefined): void {
  if (doc !== undefined) keepState(studio, kLastPlan, doc);
}

/** All topics that the window always follows, so that commands know when they may run. */
export function followAlways(studio: Studio): () => void {
  const ends = (
    [
      'studio',
      'robot',
      'clock',
      'findings',
      'scripts',
      'files',
      'breakpoints',
      'state',
      'plan',
      'history',
    ] as const
  ).map((topic) => studio.topics.subscribe(topic, {}, () => {}));
  return () => ends.forEach((end) => end());
}
