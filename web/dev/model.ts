// A development tool: the project that the stand-in pretends to serve, made from the examples.

import { readFileSync } from 'node:fs';
import type {
  Breakpoint,
  Definition,
  Doc,
  Json,
  Node,
  Topics,
  Variable,
} from '../protocol/messages';
import type { StandInPlan } from './plan';
import { crudeCompile, type Crude } from './crude_compiler';
import { makeWorld, type StandInWorld } from './world';

const examples = new URL('../../examples/', `file://${process.cwd()}/dev/`).pathname;

export interface DocState {
  text: string;
  saved: string;
  version: number;
  by: number;
}

export interface Model {
  open: boolean;
  docs: Map<Doc, DocState>;
  files: { path: string; kind: Topics['files']['is']['files'][number]['kind'] }[];
  events: Definition[];
  constants: Definition[];
  compiled: Map<Doc, Crude>;
  nodes: Node[];
  /** Nodes without a script of the project, to see many of them. */
  crowd: Node[];
  breakpoints: Breakpoint[];
  values: Record<string, unknown>;
  /** Words that a page has written, by "node address". */
  written: Map<string, number>;
  settings: Record<string, unknown>;
  clock: Topics['clock']['is'];
  target: Topics['robot']['is'];
  world: StandInWorld | null;
  plan: StandInPlan;
}

const sources: [string, string, Model['files'][number]['kind']][] = [
  ['follow-wall/WallFollow.plan.json', 'follow-wall/WallFollow.plan.json', 'plan'],
  ['follow-wall/hall.world.json', 'follow-wall/hall.world.json', 'world'],
  ['follow-wall/vagus.json', '', 'project'],
  ['carbot/carbot.aesl', 'carbot/carbot.aesl', 'script'],
  ['carbot/carbot.toolbox.json', 'carbot/carbot.toolbox.json', 'toolbox'],
  ['carbot/drive.toolbox.json', 'carbot/drive.toolbox.json', 'toolbox'],
  ['carbot/arena.world.json', 'carbot/arena.world.json', 'world'],
];

export const aesl = 'carbot/carbot.aesl';

export function makeModel(): Model {
  const model: Model = {
    open: false,
    docs: new Map(),
    files: [],
    events: [],
    constants: [],
    compiled: new Map(),
    nodes: [],
    crowd: [],
    breakpoints: [],
    values: {},
    written: new Map(),
    settings: {},
    world: null,
    plan: { state: 'none', began: 0, walldist: 30 },
    clock: { t: 0, wall: Date.now(), state: 'none', speed: 1, real: 1 },
    target: {
      target: '',
      name: '',
      kind: 'none',
      state: 'none',
      nodes: [],
      twins: [],
      lost: 0,
      events_a_second: 0,
    },
  };
  return model;
}

export function openProject(model: Model, robots = 1): void {
  model.open = true;
  model.docs.clear();
  model.files = [
    { path: 'follow-wall', kind: 'folder' },
    { path: 'carbot', kind: 'folder' },
  ];
  for (const [path, from, kind] of sources) {
    const text = from
      ? readFileSync(examples + from, 'utf8')
      : '{\n  "format": "vagus-project/1",\n  "name": "Follow a wall"\n}\n';
    model.files.push({ path, kind });
    model.docs.set(path, { text, saved: text, version: 1, by: 0 });
  }
  readAesl(model);
  model.world = makeWorld(
    JSON.parse(model.docs.get('follow-wall/hall.world.json')?.text ?? '{}') as Json,
    robots,
  );
  model.target = {
    ...model.target,
    target: 'sim',
    name: 'Simulator: Carbot',
    kind: 'simulator',
    state: 'connected',
    load: 1.1,
    lost: 0,
    events_a_second: 42,
  };
  model.breakpoints = [
    {
      doc: `${aesl}#1`,
      line: 34,
      condition: 'event.args[2] < -300',
      ignore: 0,
      enabled: true,
      hits: 1,
      set: true,
    },
  ];
}

function readAesl(model: Model): void {
  const text = model.docs.get(aesl)?.text ?? '';
  model.events = [...text.matchAll(/<event size="(\d+)" name="([^"]+)"/g)].map((match) => ({
    name: match[2] ?? '',
    value: Number(match[1]),
  }));
  model.constants = [...text.matchAll(/<constant value="(-?\d+)" name="([^"]+)"/g)].map(
    (match) => ({ name: match[2] ?? '', value: Number(match[1]) }),
  );
  const parts = [
    ...text.matchAll(/<node nodeId="(\d+)" name="([^"]+)"><!\[CDATA\[([\s\S]*?)\]\]>/g),
  ];
  model.nodes = parts.map(([, id = '0', name = '', body = ''], index) => {
    const doc = `${aesl}#${index + 1}`;
    const script = body.replaceAll('\t', '    ');
    model.docs.set(doc, { text: script, saved: script, version: 1, by: 0 });
    compile(model, doc);
    return {
      id: Number(id),
      name,
      robot: 'carbot',
      state: 'stopped',
      protocol: 5,
      described: true,
      doc,
      program: 'current',
      loaded_wall: Date.now(),
    } satisfies Node;
  });
}

export function compile(model: Model, doc: Doc): void {
  model.compiled.set(doc, crudeCompile(doc, model.docs.get(doc)?.text ?? ''));
}

/** So many nodes more; each has a hundred variables. */
export function addCrowd(model: Model, count: number): void {
  const states = ['running', 'running', 'running', 'paused', 'stopped', 'gone', 'unknown'] as const;
  model.crowd = Array.from({ length: count }, (_, index) => ({
    id: 30 + index,
    name: `thymio-${index + 1}`,
    robot: '',
    state: states[index % states.length] ?? 'running',
    protocol: 5,
    described: true,
    program: 'none',
  }));
}

export function variablesOf(node: Node | undefined): Variable[] {
  const many = Array.from({ length: 100 }, (_, index): [string, number, string] => [
    `sensor.${index}`,
    1,
    '',
  ]);
  const own: [string, number, string][] = node?.name.startsWith('thymio')
    ? many
    : node?.name === 'drive'
      ? [
          ['wheel.front.angle', 1, '0.1°'],
          ['wheel.front.speed', 1, 'mm/s'],
          ['wheel.rear.angle', 1, '0.1°'],
          ['wheel.rear.speed', 1, 'mm/s'],
          ['odometry.x', 2, 'mm'],
          ['odometry.y', 2, 'mm'],
          ['odometry.heading', 1, '0.1°'],
          ['motion.kind', 1, ''],
          ['motion.state', 1, ''],
          ['motion.left', 2, ''],
        ]
      : [
          ['sonar.angle', 1, '0.1°'],
          ['sonar.distance', 1, 'mm'],
        ];
  let address = 0;
  const make =
    (of: 'node' | 'script') =>
    ([name, size, unit]: [string, number, string]): Variable => {
      const variable: Variable = {
        name,
        address,
        size,
        of,
        ...(unit ? { unit } : {}),
        writable: true,
      };
      address += size;
      return variable;
    };
  const named: [string, number, string][] = [
    ['id', 1, ''],
    ['event.source', 1, ''],
    ['event.args', 32, ''],
    ...own,
  ];
  const script: [string, number, string][] = [
    ['token', 1, ''],
    ['patience', 1, 'ticks'],
    ['touch_ended', 1, ''],
    ['stopping', 1, ''],
    ['accepted', 1, ''],
  ];
  return [...named.map(make('node')), ...script.map(make('script'))];
}
