// A world file as a value: what it shows, and the steps (doc.patch) that edit it. The checker says
// what is wrong with a file; here what can be read is shown, and the rest is left out.

import type { Colour, Json, JsonStep } from '../../protocol/messages';
import type { Pose } from './geometry';
import { robotsOfEntry } from './grid';
import { tidy } from './snap';
import {
  bodies,
  isObjectKind,
  isRobotType,
  robotTypes,
  shapeOf,
  type ObjectKind,
  type RobotType,
  type Stage,
  type Thing,
} from './stage';

export type Table = Record<string, Json>;
/** objects/3, robots/0, timeline/2: a list of the file and a place in it. */
export type ListName = 'objects' | 'robots' | 'timeline';

export const verbs = [
  'add',
  'remove',
  'move',
  'press',
  'release',
  'light',
  'cut',
  'restore',
] as const;
export type Verb = (typeof verbs)[number];

export interface Part {
  list: ListName;
  index: number;
}

const white: Colour = [0.95, 0.95, 0.95];
const grey: Colour = [0.9, 0.9, 0.9];

export function stageOfFile(file: Json): Stage {
  const world = tableOf(file);
  const [width, height] = pairOf(world['size']) ?? [1, 1];
  const ground = tableOf(world['ground']);
  const image = ground['image'];
  return {
    name: textOf(world['name']),
    width: width > 0 ? width : 1,
    height: height > 0 ? height : 1,
    open: world['open'] === true,
    ground: colourOf(ground['colour']) ?? [1, 1, 1],
    image: typeof image === 'string' ? image : null,
    things: [
      ...listOf(world, 'objects').flatMap((one, index) =>
        objectOf(one, keyOf({ list: 'objects', index }), false),
      ),
      ...listOf(world, 'timeline').flatMap((one, index) =>
        tableOf(one)['do'] === 'add'
          ? objectOf(tableOf(one)['object'] ?? null, keyOf({ list: 'timeline', index }), true)
          : [],
      ),
      ...listOf(world, 'robots').flatMap((one, index) =>
        robotOf(one, keyOf({ list: 'robots', index })),
      ),
    ],
  };
}

export function keyOf({ list, index }: Part): string {
  return `${list}/${index}`;
}

export function partOfKey(key: string): Part | null {
  const match = /^(objects|robots|timeline)\/(\d+)$/.exec(key);
  return match ? { list: match[1] as ListName, index: Number(match[2]) } : null;
}

/** The part that a finding names: robots[0].at is robots/0. */
export function keyMeant(element: string): string | null {
  const match = /^(objects|robots|timeline)\[(\d+)\]/.exec(element);
  return match ? keyOf({ list: match[1] as ListName, index: Number(match[2]) }) : null;
}

/** Where the object or robot of a key is in the file: an entry "add" holds its object. */
export function pathOf(file: Json, key: string): (string | number)[] | null {
  const part = partOfKey(key);
  if (!part || listOf(tableOf(file), part.list)[part.index] === undefined) return null;
  const path = [part.list, part.index];
  return part.list === 'timeline' && entryOf(file, key)['do'] === 'add'
    ? [...path, 'object']
    : path;
}

/** The object, robot or entry of a key. */
export function tableAt(file: Json, key: string): Table {
  const path = pathOf(file, key);
  return path ? tableOf(valueAt(file, path)) : {};
}

/** The entry of the timeline itself, also of one that adds an object. */
export function entryOf(file: Json, key: string): Table {
  const part = partOfKey(key);
  return part ? tableOf(listOf(tableOf(file), part.list)[part.index] ?? null) : {};
}

export function listOf(world: Table, list: ListName): Json[] {
  const found = world[list];
  return Array.isArray(found) ? found : [];
}

// ---- edits ----

/** Puts something somewhere else; the angle is written only if it is not the one that is there. */
export function moveSteps(file: Json, key: string, pose: Pose): JsonStep[] {
  const path = pathOf(file, key);
  if (!path) return [];
  const table = tableOf(valueAt(file, path));
  const steps: JsonStep[] = [];
  const [x, y] = pairOf(table['at']) ?? [NaN, NaN];
  const at: [number, number] = [tidy(pose.x), tidy(pose.y)];
  if (x !== at[0] || y !== at[1]) steps.push({ do: 'set', at: [...path, 'at'], value: at });
  const angle = tidy(pose.angle);
  if (angle !== tidy(numberOf(table['angle'], 0)))
    steps.push({ do: 'set', at: [...path, 'angle'], value: angle });
  return steps;
}

/** Sets a member of a thing, or of the file (key null); undefined takes it out. */
export function setSteps(
  file: Json,
  key: string | null,
  name: string,
  value: Json | undefined,
): JsonStep[] {
  const path = key === null ? [] : pathOf(file, key);
  if (!path) return [];
  const before = tableOf(valueAt(file, path))[name];
  if (JSON.stringify(before) === JSON.stringify(value)) return [];
  return value === undefined
    ? [{ do: 'remove', at: [...path, name] }]
    : [{ do: 'set', at: [...path, name], value }];
}

/** A rectangle becomes a disc, or the other way round: one of size and radius is in the file. */
export function shapeSteps(file: Json, key: string, round: boolean): JsonStep[] {
  const table = tableAt(file, key);
  const radius = numberOf(table['radius'], 0);
  const [width, height] = pairOf(table['size']) ?? [radius * 2 || 0.2, radius * 2 || 0.2];
  return round
    ? [
        ...setSteps(file, key, 'size', undefined),
        ...setSteps(file, key, 'radius', radius || tidy(Math.min(width, height) / 2)),
      ]
    : [
        ...setSteps(file, key, 'radius', undefined),
        ...setSteps(file, key, 'size', [tidy(width), tidy(height)]),
      ];
}

/** Changes the kind with what the new kind needs: a cylinder a radius, a wall a size, no mass. */
export function kindSteps(file: Json, key: string, kind: ObjectKind): JsonStep[] {
  const table = tableAt(file, key);
  const steps = setSteps(file, key, 'kind', kind);
  const round = kind === 'cylinder' || kind === 'light' || kind === 'infrared';
  const bare = table['size'] === undefined && table['radius'] === undefined;
  const flat = kind === 'wall' || kind === 'box';
  if (round && table['size'] !== undefined) steps.push(...shapeSteps(file, key, true));
  else if (flat && (table['radius'] !== undefined || bare))
    steps.push(...shapeSteps(file, key, false));
  else if (bare && (kind === 'cylinder' || kind === 'patch'))
    steps.push(...setSteps(file, key, 'radius', 0.05));
  if (kind !== 'box' && kind !== 'cylinder') steps.push(...setSteps(file, key, 'mass', undefined));
  return steps;
}

export interface Added {
  steps: JsonStep[];
  key: string;
}

export function addSteps(file: Json, list: ListName, value: Table): Added {
  const there = tableOf(file)[list];
  const index = Array.isArray(there) ? there.length : 0;
  const steps: JsonStep[] = Array.isArray(there) ? [] : [{ do: 'set', at: [list], value: [] }];
  steps.push({ do: 'insert', at: [list, index], value });
  return { steps, key: keyOf({ list, index }) };
}

export function removeSteps(file: Json, key: string): JsonStep[] {
  const part = partOfKey(key);
  if (!part || entryOf(file, key) === noTable) return [];
  return [{ do: 'remove', at: [part.list, part.index] }];
}

/** The same once more, a little aside, under a name of its own. */
export function copySteps(file: Json, key: string): Added | null {
  const part = partOfKey(key);
  if (!part) return null;
  const table = { ...entryOf(file, key) };
  const at = pairOf(table['at']);
  if (at) table['at'] = [tidy(at[0] + 0.1), tidy(at[1] - 0.1)];
  if (part.list === 'robots') {
    table['name'] = freeName(file, textOf(table['name']));
    delete table['node'];
    delete table['port'];
  } else if (table['id'] !== undefined) table['id'] = freeName(file, textOf(table['id']));
  return addSteps(file, part.list, table);
}

export function newObject(file: Json, kind: ObjectKind, pose: Pose): Added {
  const at: Json = [tidy(pose.x), tidy(pose.y)];
  const value: Table = { id: freeName(file, kind), kind, at };
  if (tidy(pose.angle) !== 0) value['angle'] = tidy(pose.angle);
  if (kind === 'wall') value['size'] = [0.5, 0.05];
  else if (kind === 'box') value['size'] = [0.2, 0.2];
  else if (kind === 'cylinder' || kind === 'patch') value['radius'] = 0.1;
  return addSteps(file, 'objects', value);
}

export function newRobot(file: Json, type: RobotType, pose: Pose): Added {
  const names: Record<RobotType, string> = {
    thymio2: 'thymio',
    epuck: 'epuck',
    carbot: 'carbot',
  };
  const value: Table = {
    name: freeName(file, names[type]),
    type,
    at: [tidy(pose.x), tidy(pose.y)],
  };
  if (tidy(pose.angle) !== 0) value['angle'] = tidy(pose.angle);
  return addSteps(file, 'robots', value);
}

/** An entry of the timeline with what its verb needs, at its place in the order of time. */
export function newEntry(file: Json, t: number, verb: Verb): Added {
  const entry = { t, do: verb, ...membersOf(file, verb) };
  const entries = listOf(tableOf(file), 'timeline');
  const later = entries.findIndex((one) => numberOf(tableOf(one)['t'], 0) > t);
  if (later < 0) return addSteps(file, 'timeline', entry);
  return {
    steps: [{ do: 'insert', at: ['timeline', later], value: entry }],
    key: keyOf({ list: 'timeline', index: later }),
  };
}

/** The entry does something else: what the old verb needed goes. */
export function verbSteps(file: Json, key: string, verb: Verb): JsonStep[] {
  const part = partOfKey(key);
  if (!part) return [];
  const before = entryOf(file, key);
  const value: Table = { t: before['t'] ?? 0, do: verb };
  for (const [name, otherwise] of Object.entries(membersOf(file, verb)))
    value[name] = before[name] ?? otherwise;
  return [{ do: 'set', at: [part.list, part.index], value }];
}

/** Sets the time of an entry and puts it where the order of time wants it. */
export function timeSteps(file: Json, key: string, t: number): Added | null {
  const part = partOfKey(key);
  if (part?.list !== 'timeline') return null;
  const times = listOf(tableOf(file), 'timeline').map((one) => numberOf(tableOf(one)['t'], 0));
  const others = times.filter((_, index) => index !== part.index);
  const later = others.findIndex((other) => other > t);
  const to = later < 0 ? others.length : later;
  const steps: JsonStep[] = [{ do: 'set', at: ['timeline', part.index, 't'], value: t }];
  if (to !== part.index) steps.push({ do: 'move', at: ['timeline', part.index], to });
  return { steps, key: keyOf({ list: 'timeline', index: to }) };
}

/** Names that entries of the timeline can mean: ids of objects, then names of robots. */
export function namesIn(file: Json): { ids: string[]; lights: string[]; robots: string[] } {
  const world = tableOf(file);
  const objects = [
    ...listOf(world, 'objects').map(tableOf),
    ...listOf(world, 'timeline').map((one) => tableOf(tableOf(one)['object'])),
  ].filter((one) => textOf(one['id']) !== '');
  const ids = objects.map((one) => textOf(one['id']));
  const lights = objects
    .filter((one) => one['kind'] === 'light' || one['kind'] === 'infrared')
    .map((one) => textOf(one['id']));
  const robots = listOf(world, 'robots').flatMap((one) => namesOfRobots(tableOf(one)));
  return { ids, lights, robots };
}

function namesOfRobots(entry: Table): string[] {
  const first = { name: textOf(entry['name']), x: 0, y: 0 };
  return robotsOfEntry(entry, first).map((one) => one.name);
}

/** Robots with a project of their own may be in a fleet, and be cut off from it. */
export function robotsWithProject(file: Json): string[] {
  return listOf(tableOf(file), 'robots')
    .map(tableOf)
    .filter((one) => one['project'] !== undefined)
    .flatMap(namesOfRobots);
}

/** name, name2, name3: the first that nothing has. */
export function freeName(file: Json, name: string): string {
  const { ids, robots } = namesIn(file);
  const taken = new Set([...ids, ...robots]);
  if (!taken.has(name)) return name;
  const stem = name.replace(/\d+$/, '') || name;
  let count = 2;
  while (taken.has(`${stem}${count}`)) count++;
  return `${stem}${count}`;
}

function membersOf(file: Json, verb: Verb): Table {
  const { ids, lights, robots } = namesIn(file);
  const [width, height] = pairOf(tableOf(file)['size']) ?? [1, 1];
  const at: Json = [tidy(width / 2), tidy(height / 2)];
  switch (verb) {
    case 'add':
      return { object: { id: freeName(file, 'box'), kind: 'box', at, size: [0.2, 0.2] } };
    case 'remove':
      return { id: ids[0] ?? '' };
    case 'move':
      return { id: ids[0] ?? robots[0] ?? '', at };
    case 'press':
    case 'release':
      return { robot: robots[0] ?? '', button: buttonsOf(file, robots[0] ?? '')[0] ?? '' };
    case 'light':
      return { id: lights[0] ?? '', on: false };
    case 'cut':
    case 'restore':
      return { robot: robotsWithProject(file)[0] ?? '' };
  }
}

const buttons: Record<RobotType, readonly string[]> = {
  thymio2: ['backward', 'left', 'center', 'forward', 'right'],
  epuck: [],
  carbot: ['escape'],
};

/** The buttons that a robot of the file has. */
export function buttonsOf(file: Json, robot: string): readonly string[] {
  const found = listOf(tableOf(file), 'robots')
    .map(tableOf)
    .find((one) => namesOfRobots(one).includes(robot));
  const type = found?.['type'];
  return isRobotType(type) ? buttons[type] : [];
}

// ---- reading ----

const noTable: Table = {};

export function tableOf(value: Json | undefined): Table {
  return typeof value === 'object' && value !== null && !Array.isArray(value) ? value : noTable;
}

export function textOf(value: Json | undefined): string {
  return typeof value === 'string' ? value : '';
}

export function numberOf(value: Json | undefined, otherwise: number): number {
  return typeof value === 'number' ? value : otherwise;
}

export function pairOf(value: Json | undefined): [number, number] | null {
  if (!Array.isArray(value)) return null;
  const [a, b] = value;
  return typeof a === 'number' && typeof b === 'number' ? [a, b] : null;
}

export function colourOf(value: Json | undefined): Colour | null {
  if (!Array.isArray(value)) return null;
  const [red, green, blue] = value;
  return typeof red === 'number' && typeof green === 'number' && typeof blue === 'number'
    ? [red, green, blue]
    : null;
}

function valueAt(value: Json, path: readonly (string | number)[]): Json {
  let found: Json | undefined = value;
  for (const key of path)
    found =
      typeof key === 'number'
        ? Array.isArray(found)
          ? found[key]
          : undefined
        : tableOf(found)[key];
  return found ?? null;
}

function objectOf(value: Json, key: string, later: boolean): Thing[] {
  const table = tableOf(value);
  const at = pairOf(table['at']);
  const kind = table['kind'];
  if (!at || !isObjectKind(kind)) return [];
  const size = pairOf(table['size']);
  return [
    {
      key,
      name: textOf(table['id']),
      kind,
      shape: shapeOf(size ?? undefined, numberOf(table['radius'], 0)),
      pose: { x: at[0], y: at[1], angle: numberOf(table['angle'], 0) },
      height: numberOf(table['height'], 0.1),
      colour: colourOf(table['colour']) ?? grey,
      on: true,
      later,
    },
  ];
}

function robotOf(value: Json, key: string): Thing[] {
  const table = tableOf(value);
  const at = pairOf(table['at']);
  const type = robotTypes.find((one) => one === table['type']);
  if (!at || !type) return [];
  // The first robot of a grid stands for its entry; the others are shown, and move with it.
  const first = { name: textOf(table['name']), x: at[0], y: at[1] };
  return robotsOfEntry(table, first).map(({ name, x, y }, place) => ({
    key: place === 0 ? key : `${key}/${place}`,
    name,
    kind: 'robot',
    type,
    ...bodies[type],
    pose: { x, y, angle: numberOf(table['angle'], 0) },
    colour: colourOf(table['paint']) ?? white,
    on: true,
    later: false,
  }));
}
