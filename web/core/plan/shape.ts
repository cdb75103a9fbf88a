// How large the elements of a plan are drawn, and where the rows of their states and events are.
// All in pixels of the canvas (docs: look, "Measures").

import type { Actor, PlanModel, Supervisor } from './model';

export interface Point {
  x: number;
  y: number;
}

export interface Box extends Point {
  width: number;
  height: number;
}

export const kNodeWidth = 168;
const kHead = 44;
export const kRow = 22;
const kFoot = 4;
export const kSupervisorInset = 8;
export const kSupervisorGap = 4;
const kSupervisorHead = 24;
const kEventRow = 16;
export const kStartSize = { width: 84, height: 30 };
export const kPill = { width: 168, height: 28, gap: 8 };
const kPillColumns = 4;
/** Of the small round tags. */
export const kTag = 22;
/** Height above which an arrow comes in at the side: at the name. */
export const kEntry = 22;

export function actorHeight(actor: Actor): number {
  return kHead + kRow * actor.outcomes.length + kFoot;
}

export function supervisorHeight(supervisor: Supervisor): number {
  return kSupervisorHead + kEventRow * Math.max(1, supervisor.outcomes.length);
}

/** Where the arrow of a state leaves, below the top of its actor. */
export function stateRow(index: number): number {
  return kHead + kRow * index + kRow / 2;
}

/** The only event leaves at the tip, several at their rows. */
export function eventRow(supervisor: Supervisor, index: number): number {
  const count = supervisor.outcomes.length;
  if (count <= 1) return supervisorHeight(supervisor) / 2;
  return kSupervisorHead - kEventRow / 2 + kEventRow * index + kEventRow / 2;
}

/** An actor with the supervisors under it, or the start tag with the global ones. */
export interface Block {
  name: string;
  box: Box;
  whole: Box;
  supervisors: readonly { supervisor: Supervisor; box: Box }[];
}

export function blockAt(
  name: string,
  at: Point,
  size: { width: number; height: number },
  supervisors: readonly Supervisor[],
): Block {
  const box = { ...at, ...size };
  let y = at.y + size.height + kSupervisorGap;
  const hanging = supervisors.map((supervisor) => {
    const height = supervisorHeight(supervisor);
    const width = kNodeWidth - 2 * kSupervisorInset;
    const place = { x: at.x + kSupervisorInset, y, width, height };
    y += height + kSupervisorGap;
    return { supervisor, box: place };
  });
  const width = supervisors.length > 0 ? Math.max(size.width, kNodeWidth) : size.width;
  const height = y - kSupervisorGap - at.y;
  return { name, box, whole: { ...at, width, height }, supervisors: hanging };
}

export function actorBlock(actor: Actor, at: Point): Block {
  const size = { width: kNodeWidth, height: actorHeight(actor) };
  return blockAt(actor.name, at, size, actor.supervisors);
}

export function pillBoxes(model: PlanModel, at: Point): { name: string; box: Box }[] {
  return model.variables.map(({ name }, index) => {
    const column = index % kPillColumns;
    const row = Math.floor(index / kPillColumns);
    const { width, height, gap } = kPill;
    const place = { x: at.x + column * (width + gap), y: at.y + row * (height + gap) };
    return { name, box: { ...place, width, height } };
  });
}

export function around(boxes: readonly Box[]): Box {
  if (boxes.length === 0) return { x: 0, y: 0, width: 0, height: 0 };
  const x = Math.min(...boxes.map((box) => box.x));
  const y = Math.min(...boxes.map((box) => box.y));
  const right = Math.max(...boxes.map((box) => box.x + box.width));
  const bottom = Math.max(...boxes.map((box) => box.y + box.height));
  return { x, y, width: right - x, height: bottom - y };
}

/** With so much more on each side; less if that is negative. */
export function grown({ x, y, width, height }: Box, by: number): Box {
  return { x: x - by, y: y - by, width: width + 2 * by, height: height + 2 * by };
}

export function overlaps(a: Box, b: Box, gap = 0): boolean {
  return (
    a.x < b.x + b.width + gap &&
    b.x < a.x + a.width + gap &&
    a.y < b.y + b.height + gap &&
    b.y < a.y + a.height + gap
  );
}
