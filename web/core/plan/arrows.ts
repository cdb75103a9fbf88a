// The action arrows of a scene: from which row, on which side, to which element; and the small tags
// of those that end the plan or ignore.

import {
  kIgnore,
  kStart,
  kTerminate,
  type Actor,
  type Note,
  type Outcome,
  type PlanModel,
  type Supervisor,
} from './model';
import type { Routed } from './path';
import { blocksOf, type Scene } from './place';
import { kTight, outOf, Routing, type Port, type Side, type Way } from './route';
import { eventRow, kEntry, kTag, overlaps, stateRow, type Block, type Box } from './shape';

export interface Arrow {
  id: string;
  /** An actor, a supervisor, or @start. */
  source: string;
  /** Its state or event; '' of the start. */
  outcome: string;
  target: string;
  port: Port;
}

/** A state or event that leads nowhere yet. */
export interface Loose {
  id: string;
  source: string;
  outcome: string;
  port: Port;
}

export interface Tag {
  id: string;
  source: string;
  outcome: string;
  is: 'terminate' | 'ignore';
  box: Box;
}

export interface Drawing {
  arrows: readonly Arrow[];
  loose: readonly Loose[];
  tags: readonly Tag[];
  routes: ReadonlyMap<string, Routed>;
  /** Some ways are only sketched: goOn() finds more of them. */
  isSketch: boolean;
  /** The side on which each row of an element is, by id of its arrow. */
  sides: ReadonlyMap<string, Side>;
}

/** From the port to its tag. */
const kTagGap = 22;

export const arrowId = (source: string, outcome: string) => `${source}.${outcome}`;

export interface Pace {
  /** It is time to stop looking for ways. Without it all are found. */
  isTime?: () => boolean;
  /** Ways of before that still fit are shown where no better one is found yet. */
  before?: Drawing;
  /** They are kept, even where there would be better ones now. */
  keeps?: boolean;
}

const routings = new WeakMap<Drawing, Routing>();

export function drawingOf(model: PlanModel, scene: Scene, pace: Pace = {}): Drawing {
  const rows = rowsOf(model, scene);
  const elements = boxesOf(scene);
  const boxes = [...elements, ...notesInTheWay(model.notes, elements)];
  const tags = rows.flatMap((row) => tagOf(row, boxes) ?? []);
  const ports = new Map(rows.map((row) => [row.id, portOf(row, tags)]));
  const portAt = (row: Row): Port => ports.get(row.id) ?? portOn(row, 'right');
  const entries = entriesOf(scene);
  const led = rows.filter(({ target }) => target !== null && entries.has(target));
  const arrows = led.map((row) => ({ ...row, target: row.target ?? '', port: portAt(row) }));
  const all = [...boxes, ...tags.map(({ box }) => box)];
  const routing = new Routing(
    all,
    arrows.map((arrow) => wayOf(arrow, entries.get(arrow.target) ?? [])),
  );
  if (pace.keeps) for (const known of pace.before?.routes.values() ?? []) routing.keep(known);
  const drawing: Drawing = {
    arrows: [
      ...arrows,
      ...tags.map((tag) => ({ ...tag, target: targetOf(tag), port: portOfTag(tag, ports) })),
    ],
    loose: rows
      .filter(({ target, id }) => !tags.some((tag) => tag.id === id) && !entries.has(target ?? ''))
      .map((row) => ({ ...row, port: portAt(row) })),
    tags,
    routes: new Map(tags.map((tag): [string, Routed] => [tag.id, toTag(tag, ports.get(tag.id))])),
    isSketch: true,
    sides: new Map([...ports].map(([id, { side }]) => [id, side])),
  };
  routings.set(drawing, routing);
  return goOn(drawing, pace);
}

/** The same drawing with more of its ways found. */
export function goOn(drawing: Drawing, { isTime = () => false, before }: Pace = {}): Drawing {
  const routing = routings.get(drawing);
  if (!routing) return drawing;
  routing.work(isTime);
  const rest = routing.rest(before?.routes ?? drawing.routes).map((one) => [one.id, one] as const);
  const routes = new Map([...drawing.routes, ...rest, ...routing.found]);
  const next = { ...drawing, routes, isSketch: !routing.done };
  if (!routing.done) routings.set(next, routing);
  return next;
}

interface Row {
  id: string;
  source: string;
  outcome: string;
  target: string | null;
  box: Box;
  /** Below the top of the box. */
  down: number;
  /** Where its target is, if it is an element. */
  aim: Box | undefined;
}

function rowsOf(model: PlanModel, scene: Scene): Row[] {
  const boxOf = new Map(scene.actors.map((block) => [block.name, block.box]));
  const blocks = new Map(blocksOf(scene).map((block) => [block.name, block]));
  const row = (source: string, box: Box, down: number, outcome: Outcome): Row => ({
    id: arrowId(source, outcome.name),
    source,
    outcome: outcome.name,
    target: outcome.target,
    box,
    down,
    aim: boxOf.get(outcome.target ?? ''),
  });
  const ofActor = (actor: Actor, block: Block) =>
    actor.outcomes.map((one, index) => row(actor.name, block.box, stateRow(index), one));
  const ofSupervisors = (block: Block) =>
    block.supervisors.flatMap(({ supervisor, box }) =>
      supervisor.outcomes.map((one, index) =>
        row(supervisorKey(supervisor), box, eventRow(supervisor, index), one),
      ),
    );
  const first = { name: '', target: model.first, help: '' };
  return [
    row(kStart, scene.start.box, scene.start.box.height / 2, first),
    ...ofSupervisors(scene.start),
    ...model.actors.flatMap((actor) => {
      const block = blocks.get(actor.name);
      return block ? [...ofActor(actor, block), ...ofSupervisors(block)] : [];
    }),
  ];
}

/** Apart from actors, which may have the same name. */
/** An interruption by a supervisor, not a state in which an actor ends. No name has a slash. */
export function isEvent(source: string): boolean {
  return source.includes('/');
}

export function supervisorKey(supervisor: Pick<Supervisor, 'owner' | 'name'>): string {
  return `${supervisor.owner}/${supervisor.name}`;
}

function portOn(row: Row, side: 'left' | 'right'): Port {
  const { box, down } = row;
  return { x: side === 'left' ? box.x : box.x + box.width, y: box.y + down, side };
}

/** Rows face their target; those that lead to a tag face it. */
function portOf(row: Row, tags: readonly Tag[]): Port {
  const tag = tags.find((one) => one.id === row.id);
  if (tag) return portOn(row, tag.box.x < row.box.x ? 'left' : 'right');
  const { aim, box } = row;
  return portOn(row, aim && aim.x + aim.width / 2 < box.x ? 'left' : 'right');
}

function tagOf(row: Row, boxes: readonly Box[]): Tag | undefined {
  if (row.target !== kTerminate && row.target !== kIgnore) return undefined;
  const at = (side: 'left' | 'right'): Box => {
    const middle = outOf(portOn(row, side), kTagGap + kTag / 2);
    return { x: middle.x - kTag / 2, y: middle.y - kTag / 2, width: kTag, height: kTag };
  };
  const isFree = (box: Box) => !boxes.some((one) => overlaps(one, box, kTag / 2));
  const box = isFree(at('right')) || !isFree(at('left')) ? at('right') : at('left');
  const is = row.target === kTerminate ? 'terminate' : 'ignore';
  return { id: row.id, source: row.source, outcome: row.outcome, is, box };
}

const targetOf = (tag: Tag) => (tag.is === 'terminate' ? kTerminate : kIgnore);

function portOfTag(tag: Tag, ports: ReadonlyMap<string, Port>): Port {
  return ports.get(tag.id) ?? { x: tag.box.x, y: tag.box.y, side: 'right' };
}

function toTag(tag: Tag, port: Port | undefined): Routed {
  const from = port ?? { x: tag.box.x, y: tag.box.y + kTag / 2, side: 'right' as const };
  return { id: tag.id, points: [{ x: from.x, y: from.y }, outOf(from, kTagGap)] };
}

function boxesOf(scene: Scene): Box[] {
  const blocks = blocksOf(scene);
  return [
    ...blocks.map((block) => block.box),
    ...blocks.flatMap((block) => block.supervisors.map(({ box }) => box)),
    ...scene.pills.map(({ box }) => box),
  ];
}

/** Notes stand in the way of arrows, but for those that are a ground on which elements stand. */
function notesInTheWay(notes: readonly Note[], elements: readonly Box[]): Box[] {
  return notes
    .map(({ at: [x, y], size: [width, height] }) => ({ x, y, width, height }))
    .filter((box) => !elements.some((one) => overlaps(one, box, kTight.in + kTight.clear)));
}

/** Left and right at the name, above, and below where nothing hangs. */
function entriesOf(scene: Scene): Map<string, Port[]> {
  return new Map(
    scene.actors.map(({ name, box, supervisors }) => {
      const { x, y, width, height } = box;
      const entries: Port[] = [
        { x, y: y + kEntry, side: 'left' },
        { x: x + width, y: y + kEntry, side: 'right' },
        { x: x + width / 2, y, side: 'top' },
      ];
      if (supervisors.length === 0)
        entries.push({ x: x + width / 2, y: y + height, side: 'bottom' });
      return [name, entries];
    }),
  );
}

function wayOf(arrow: Arrow, entries: readonly Port[]): Way {
  return { id: arrow.id, from: arrow.port, entries, aim: arrow.target };
}
