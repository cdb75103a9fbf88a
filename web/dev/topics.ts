// A development tool: what the stand-in says on each topic.

import type { Json, Topics } from '../protocol/messages';
import { planOf } from './plan';
import { aesl, variablesOf, type Model } from './model';

export const documents: {
  [T in keyof Topics]?: (model: Model, of: Record<string, Json>) => unknown;
} = {
  studio: (model) => ({
    version: 'stand-in',
    driver: 1,
    driver_name: 'this page',
    clients: 1,
    settings: model.settings,
    recovered: [],
    ...(model.open
      ? {
          project: {
            folder: '/home/you/Vagus/follow-wall',
            name: 'follow-wall',
            help: '',
            copy_of: 'follow-wall',
            plan: 'follow-wall/WallFollow.plan.json',
            world: 'follow-wall/hall.world.json',
            scripts: [aesl],
            target: 'sim',
          },
        }
      : {}),
  }),
  start: () => ({ examples, recent: [] }),
  targets: (model) => ({ found: model.values['found'] ?? [] }),
  files: (model) => ({
    files: model.files.map((file) => ({
      ...file,
      size: model.docs.get(file.path)?.saved.length ?? 0,
      unsaved: isUnsaved(model, file.path),
    })),
    more: false,
  }),
  doc: (model, of) => {
    const doc = model.docs.get(String(of['doc']));
    return {
      version: doc?.version ?? 0,
      text: doc?.text ?? '',
      unsaved: doc ? doc.text !== doc.saved : false,
      by: doc?.by ?? 0,
      gone: !doc,
    };
  },
  templates: () => ({ toolboxes: [] }),
  findings: (model) => ({
    findings: [...model.compiled.values()].flatMap((one) => one.findings),
    more: 0,
    versions: Object.fromEntries(
      [...model.compiled.keys()].map((doc) => [doc, model.docs.get(doc)?.version ?? 0]),
    ),
  }),
  script: (model, of) => {
    const doc = String(of['doc']);
    const compiled = model.compiled.get(doc);
    const node = model.nodes.find((one) => one.doc === doc);
    return {
      version: model.docs.get(doc)?.version ?? 0,
      good: !compiled?.findings.some((one) => one.severity === 'error'),
      node: node?.name ?? '',
      for: 'carbot',
      bytecode: { used: compiled?.words ?? 0, of: 2048 },
      variables: { used: compiled?.variables ?? 0, of: 640 },
      stack: { used: 9, of: 32 },
      handlers: compiled?.handlers ?? [],
      code_lines: compiled?.codeLines ?? [],
    };
  },
  scripts: (model) => ({
    parts: model.nodes.map((node) => ({
      doc: node.doc,
      name: node.name,
      node: node.id,
      file: aesl,
    })),
    files: model.open ? [{ path: aesl, events: model.events, constants: model.constants }] : [],
  }),
  robot: (model) => ({
    ...model.target,
    nodes: model.open && model.target.kind !== 'none' ? [...model.nodes, ...model.crowd] : [],
  }),
  node: (model, of) => ({
    name: nodeOf(model, of)?.name ?? '',
    variables: variablesOf(nodeOf(model, of)),
    events: [{ name: 'tick', help: 'Every 20 ms.' }],
    natives: [],
  }),
  breakpoints: (model) => ({ breakpoints: model.breakpoints }),
  clock: (model) => model.clock,
  state: (model) => ({ values: model.values['state'] ?? {} }),
  network: (model) => network(model),
  plan: planOf,
  scene: (model) =>
    model.world && model.clock.state !== 'none'
      ? model.world.scene
      : { name: '', size: [1, 1], open: false, ground: [1, 1, 1], robots: [], objects: [] },
};

function nodeOf(model: Model, of: Record<string, Json>) {
  return [...model.nodes, ...model.crowd].find((node) => node.id === of['node']);
}

/** Who says what to whom, growing with the clock. */
function network(model: Model): Topics['network']['is'] {
  const all = [...model.nodes, ...model.crowd].map((node) => node.id);
  const talk: [number, string, number, number[]][] = [
    [0, 'drive.steer', 12, [1]],
    [0, 'drive.alive', 4, [1]],
    [3, 'range.measured', 16, [0]],
    [2, 'touched', 0.3, [1, 4]],
    [1, 'halted', 0.2, []],
    [4, 'head.seen', 5, [1, 3]],
    ...model.crowd.map((node, index): [number, string, number, number[]] => [
      node.id,
      `swarm.${['near', 'far', 'here'][index % 3]}`,
      (index % 7) + 0.5,
      model.crowd.filter((_, other) => other % 4 === index % 4).map((other) => other.id),
    ]),
  ];
  const count = (rate: number) => Math.round(model.clock.t * rate);
  return {
    links: [
      {
        name: model.target.name,
        nodes: all,
        frames_in: count(40),
        frames_out: count(18),
        lost: model.target.lost,
      },
    ],
    traffic: talk.map(([from, event, rate, to]) => ({ from, event, count: count(rate), to })),
  };
}

function isUnsaved(model: Model, path: string): boolean {
  return [...model.docs].some(
    ([doc, state]) => (doc === path || doc.startsWith(`${path}#`)) && state.text !== state.saved,
  );
}

const examples = [
  {
    id: 'follow-wall',
    name: 'Follow a wall',
    help: 'Find a wall, drive along it until the escape button is pressed.',
    robot: 'Carbot',
    content: 'Plan · 6 actors',
  },
  {
    id: 'find-object',
    name: 'Find an object',
    help: 'Look for one colour with the camera and drive to it.',
    robot: 'Carbot',
    content: 'Plan · 14 actors',
  },
  {
    id: 'rooms',
    name: 'Go to a room',
    help: 'Along the hall and through the door, with sub-plans.',
    robot: 'Carbot',
    content: '3 plans',
  },
  {
    id: 'obstacle',
    name: 'Around an obstacle',
    help: 'Touch, back up, go aside, try again.',
    robot: 'Carbot, Thymio II',
    content: 'Plan · 11 actors',
  },
  {
    id: 'infrared',
    name: 'Drive to a beacon',
    help: 'Seek an infrared beacon behind a wall.',
    robot: 'Carbot',
    content: 'Plan · 9 actors',
  },
  {
    id: 'thymio',
    name: 'Explore an arena',
    help: 'A script alone: drive, turn away from what is near.',
    robot: 'Thymio II',
    content: 'Script · 1 node',
  },
  {
    id: 'patterns',
    name: 'Drive patterns',
    help: 'A square and a figure of eight.',
    robot: 'Carbot, Thymio II',
    content: '2 plans',
  },
  {
    id: 'follow-object',
    name: 'Follow another robot',
    help: 'Keep a distance to a robot that drives ahead.',
    robot: 'Carbot',
    content: 'Plan · 8 actors',
  },
  {
    id: 'traffic-light',
    name: 'Stop at a traffic light',
    help: 'A supervisor of your own on a node.',
    robot: 'Carbot',
    content: 'Plan · 3 actors',
  },
];
