// Variables that were picked out, for the watch table and for plots: by node and name, so that they
// are found again after the next compilation. Kept in the window's state as plain JSON.

import type { Json, NodeId, Variable } from '../protocol/messages';
import { Emitter } from './emitter';

export interface Pick {
  node: NodeId;
  name: string;
  /** An element of an array; without it the whole variable. */
  index?: number;
}

/** Stands for the plan where a pick names its node: its variables are seen beside those of nodes. */
export const kPlanNode = -1;
/** What the plan is called in front of a name: "plan.distance". */
export const kPlanName = 'plan';

export const kPicksMax = 200;

export function pickKey({ node, name, index }: Pick): string {
  return index === undefined ? `${node}/${name}` : `${node}/${name}[${index}]`;
}

export function pickName({ name, index }: Pick): string {
  return index === undefined ? name : `${name}[${index}]`;
}

/** With the pick, if it is not there and there is room. */
export function added(picks: readonly Pick[], pick: Pick): Pick[] {
  const key = pickKey(pick);
  if (picks.length >= kPicksMax || picks.some((one) => pickKey(one) === key)) return [...picks];
  return [...picks, pick];
}

export function removed(picks: readonly Pick[], pick: Pick): Pick[] {
  const key = pickKey(pick);
  return picks.filter((one) => pickKey(one) !== key);
}

/** Moves a pick by so many places among those of its node. */
export function moved(picks: readonly Pick[], pick: Pick, by: number): Pick[] {
  const own = picks.filter((one) => one.node === pick.node);
  const at = own.findIndex((one) => pickKey(one) === pickKey(pick));
  const other = own[at + by];
  if (at < 0 || !other) return [...picks];
  const out = [...picks];
  const [from, to] = [picks.indexOf(own[at] as Pick), picks.indexOf(other)];
  [out[from], out[to]] = [other, own[at] as Pick];
  return out;
}

/** Where a pick is now; undefined if its node does not have such a variable (any more). */
export function placeOf(
  pick: Pick,
  variables: readonly Variable[],
): { variable: Variable; first: number; count: number } | undefined {
  const variable = variables.find((one) => one.name === pick.name);
  if (!variable || (pick.index ?? 0) >= variable.size) return undefined;
  return pick.index === undefined
    ? { variable, first: variable.address, count: variable.size }
    : { variable, first: variable.address + pick.index, count: 1 };
}

/** "name", "name[3]", "node.name[3]", "plan.name": a pick as it is typed; node is the one that is meant without. */
export function readPick(
  text: string,
  nodes: readonly { id: NodeId; name: string }[],
  node: NodeId | null,
): Pick | null {
  const typed = text.trim();
  // The name of a node may hold what that of a variable may not: thymio-II.
  const own = [...nodes, { id: kPlanNode, name: kPlanName }].find((one) =>
    typed.startsWith(`${one.name}.`),
  );
  const rest = own ? typed.slice(own.name.length + 1) : typed;
  const [, name, index] = /^([A-Za-z_][\w.]*)(?:\[(\d+)\])?$/.exec(rest) ?? [];
  const id = own?.id ?? node;
  if (!name || id === null) return null;
  return index === undefined ? { node: id, name } : { node: id, name, index: Number(index) };
}

export function readPicks(json: Json | undefined): Pick[] {
  if (!Array.isArray(json)) return [];
  return json.slice(0, kPicksMax).flatMap((one) => {
    const pick = asPick(one);
    return pick ? [pick] : [];
  });
}

export function asPick(json: Json | undefined): Pick | null {
  if (typeof json !== 'object' || json === null || Array.isArray(json)) return null;
  const { node, name, index } = json;
  if (typeof node !== 'number' || typeof name !== 'string' || name === '') return null;
  if (index === undefined) return { node, name };
  return typeof index === 'number' && Number.isInteger(index) && index >= 0
    ? { node, name, index }
    : null;
}

export function picksJson(picks: readonly Pick[]): Json {
  return picks.map((pick): Json => ({ ...pick }));
}

/** A list of picks that several places show. */
export class PickList {
  readonly changed = new Emitter<void>();
  list: readonly Pick[] = [];

  set(list: readonly Pick[]): void {
    this.list = list;
    this.changed.emit();
  }

  toggle(pick: Pick): void {
    this.set(this.has(pick) ? removed(this.list, pick) : added(this.list, pick));
  }

  has(pick: Pick): boolean {
    const key = pickKey(pick);
    return this.list.some((one) => pickKey(one) === key);
  }
}
