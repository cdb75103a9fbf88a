// A development tool: what the stand-in does on each command.

import type { CommandName, Commands, Json, Problem } from '../protocol/messages';
import { applySteps } from '../core/json_steps';
import { shapeOf } from '../core/world/stage';
import { suggestions, wordAt } from './crude_compiler';
import { aesl, compile, openProject, variablesOf, type Model } from './model';
import { addObject } from './world';

export class Refused extends Error {
  constructor(readonly problem: Problem) {
    super(problem.what);
  }
}

type Act = (model: Model, input: never, client: number) => unknown;
type Acts = {
  [C in CommandName]?: (
    model: Model,
    input: Commands[C]['in'],
    client: number,
  ) => Commands[C]['out'];
};

const acts: Acts = {
  'project.example': (model, input) => (
    openProject(model),
    { path: `/home/you/Vagus/${input.id}` }
  ),
  'project.open': (model, input) => (openProject(model), { path: input.path }),
  'project.new': (model, input) => (openProject(model), { path: `/home/you/Vagus/${input.name}` }),
  'project.close': (model) => ((model.open = false), {}),
  'folder.list': (_model, input) => folderOf(input.path),
  'doc.open': (model, input) => {
    const doc = docOf(model, input.doc);
    return {
      text: doc.text,
      version: doc.version,
      language: languageOf(input.doc),
      unsaved: doc.text !== doc.saved,
    };
  },
  'doc.edit': (model, input, client) => {
    const doc = docOf(model, input.doc);
    if (input.version !== doc.version)
      throw new Refused({ code: 'conflict', what: `The text is at version ${doc.version}.` });
    for (const change of [...input.changes].sort((a, b) => b.from - a.from))
      doc.text = doc.text.slice(0, change.from) + change.text + doc.text.slice(change.to);
    doc.version++;
    doc.by = client;
    touched(model, input.doc);
    return { version: doc.version };
  },
  'doc.patch': (model, input, client) => {
    const doc = docOf(model, input.doc);
    if (input.version !== doc.version)
      throw new Refused({ code: 'conflict', what: `The text is at version ${doc.version}.` });
    const { value } = applySteps(JSON.parse(doc.text) as Json, input.steps);
    doc.text = `${JSON.stringify(value, null, 2)}\n`;
    doc.version++;
    doc.by = client;
    return { version: doc.version, text: doc.text };
  },
  'world.move': (model, input) => {
    const pose = { x: input.at[0] ?? 0, y: input.at[1] ?? 0, angle: input.angle ?? 0 };
    if (input.robot !== undefined) {
      model.world?.poses.set(input.robot, pose);
      model.world?.put.add(input.robot);
    } else model.world?.objects.set(input.object ?? 0, pose);
    return {};
  },
  'world.put': (model, input) => ({
    number: model.world
      ? addObject(model.world, {
          name: '',
          kind: input.kind,
          height: 0.1,
          colour: [0.8, 0.5, 0.3],
          pose: { x: input.at[0] ?? 0, y: input.at[1] ?? 0, angle: input.angle ?? 0 },
          shape: shapeOf(input.size, input.radius ?? 0),
        })
      : 0,
  }),
  'world.take': (model, input) => {
    const { world } = model;
    if (!world) return {};
    world.objects.delete(input.object);
    world.scene = {
      ...world.scene,
      objects: world.scene.objects.filter((one) => one.number !== input.object),
    };
    return {};
  },
  'plan.start': (model) => {
    model.plan = { ...model.plan, state: 'running', began: model.clock.t };
    model.clock = { ...model.clock, state: 'running' };
    return {};
  },
  'plan.pause': (model) => ((model.plan.state = 'paused'), {}),
  'plan.continue': (model) => ((model.plan.state = 'running'), {}),
  'plan.step': () => ({}),
  'plan.stop': (model) => ((model.plan.state = 'ended'), {}),
  'plan.set': (model, input) => ((model.plan.walldist = input.value), {}),
  'doc.save': (model, input) => (save(model, input.doc), {}),
  'doc.save_all': (model) => ({
    saved: [...model.docs.keys()].filter((doc) => save(model, doc)),
  }),
  'file.new': (model, input) => {
    model.files.push({ path: input.path, kind: input.kind });
    if (input.kind !== 'folder')
      model.docs.set(input.path, { text: '', saved: '', version: 1, by: 0 });
    return {};
  },
  'file.rename': (model, input) => {
    for (const file of model.files)
      if (file.path === input.path || file.path.startsWith(`${input.path}/`))
        file.path = input.to + file.path.slice(input.path.length);
    const doc = model.docs.get(input.path);
    if (doc) model.docs.set(input.to, doc);
    return { followed: [] };
  },
  'file.delete': (model, input) => (
    (model.files = model.files.filter(
      (file) => file.path !== input.path && !file.path.startsWith(`${input.path}/`),
    )),
    {}
  ),
  'file.bytes': (model, input) => ({
    base64: Buffer.from(docOf(model, input.path).saved).toString('base64'),
  }),
  'script.complete': (model, input) => {
    const found = wordAt(docOf(model, input.doc).text, input.at);
    return {
      from: found.from,
      items: suggestions(
        docOf(model, input.doc).text,
        model.events.map((event) => event.name),
      ),
    };
  },
  'script.hover': (model, input) => {
    const found = wordAt(docOf(model, input.doc).text, input.at);
    if (!/^[a-z_]/i.test(found.word)) return { found: false };
    const event = model.events.find((one) => one.name === found.word);
    return {
      found: true,
      at: found.from,
      end: found.to,
      title: event ? `event ${event.name} (${event.value})` : found.word,
      help: event
        ? 'An event of the project, sent to all nodes.'
        : 'A word of one number, -32768 to 32767.',
    };
  },
  'script.definition': (model, input) => {
    const { word } = wordAt(docOf(model, input.doc).text, input.at);
    return {
      spots: spotsOf(
        model,
        input.doc,
        new RegExp(`(?<=(?:var|const|sub|onevent) +)${escaped(word)}(?![\\w.])`, 'g'),
      ).slice(0, 1),
    };
  },
  'script.references': (model, input) => {
    const { word } = wordAt(docOf(model, input.doc).text, input.at);
    return {
      name: word,
      spots: model.nodes.flatMap((node) =>
        spotsOf(model, node.doc ?? '', new RegExp(`(?<![\\w.])${escaped(word)}(?![\\w.])`, 'g')),
      ),
    };
  },
  'script.rename': (model, input) => {
    const { word } = wordAt(docOf(model, input.doc).text, input.at);
    return replaceAll(
      model,
      new RegExp(`(?<![\\w.])${escaped(word)}(?![\\w.])`, 'g'),
      input.to,
      model.nodes.map((node) => node.doc ?? ''),
    );
  },
  'script.listing': (model, input) => {
    const lines = model.compiled.get(input.doc)?.codeLines ?? [];
    return {
      lines: lines.map((line, index) => ({
        line,
        address: 5 + index * 2,
        words: 2,
        text: index % 3 === 0 ? 'load token' : index % 3 === 1 ? 'push 1' : 'if == 12',
      })),
    };
  },
  'script.format_name': (_model, input) => ({
    good: /^[A-Za-z_][\w.]*$/.test(input.name),
    why: 'A name begins with a letter or _.',
  }),
  'text.search': (model, input) => {
    const pattern = patternOf(input);
    return {
      spots: [...model.docs.keys()]
        .filter((doc) => doc !== aesl)
        .flatMap((doc) => spotsOf(model, doc, pattern)),
      more: false,
    };
  },
  'text.replace': (model, input) =>
    replaceAll(model, patternOf(input), input.by, input.docs ?? [...model.docs.keys()]),
  'define.add': (model, input) => (
    (input.kind === 'event' ? model.events : model.constants).push({
      name: input.name,
      value: input.value,
    }),
    {}
  ),
  'define.change': (model, input) => {
    for (const one of input.kind === 'event' ? model.events : model.constants)
      if (one.name === input.name) Object.assign(one, { name: input.to, value: input.value });
    return { places: 1 };
  },
  'define.remove': (model, input) => {
    if (input.kind === 'event')
      model.events = model.events.filter((one) => one.name !== input.name);
    else model.constants = model.constants.filter((one) => one.name !== input.name);
    return {};
  },
  'break.set': (model, input) => {
    const known = model.breakpoints.find((one) => one.doc === input.doc && one.line === input.line);
    const made = known ?? {
      doc: input.doc,
      line: input.line,
      condition: '',
      ignore: 0,
      enabled: true,
      hits: 0,
      set: true,
    };
    model.breakpoints = [
      ...model.breakpoints.filter((one) => one !== known),
      {
        ...made,
        condition: input.condition ?? made.condition,
        ignore: input.ignore ?? made.ignore,
        enabled: input.enabled ?? made.enabled,
      },
    ];
    return { line: input.line };
  },
  'break.clear': (model, input) => (
    (model.breakpoints = model.breakpoints.filter(
      (one) =>
        input.doc !== undefined &&
        (one.doc !== input.doc || (input.line !== undefined && one.line !== input.line)),
    )),
    {}
  ),
  'run.start': (model) => (
    setNodes(model, 'running'),
    (model.clock = { ...model.clock, state: 'running' }),
    {}
  ),
  'run.pause': (model) => (
    setNodes(model, 'paused'),
    (model.clock = { ...model.clock, state: 'paused' }),
    {}
  ),
  'run.step': (model) => ((model.clock = { ...model.clock, t: model.clock.t + 0.01 }), {}),
  'run.reset': (model) => ((model.clock = { ...model.clock, t: 0 }), {}),
  'clock.speed': (model, input) => ((model.clock = { ...model.clock, speed: input.speed }), {}),
  stop: (model) => (
    setNodes(model, 'stopped'),
    (model.clock = { ...model.clock, state: 'none', t: 0 }),
    { stood: [1, 2, 3, 4] }
  ),
  'node.load': (model, input) => {
    const chosen = model.nodes.filter((node) => input.node === 0 || node.id === input.node);
    for (const node of chosen) Object.assign(node, { program: 'current', loaded_wall: Date.now() });
    return { loaded: chosen.map((node) => node.id), failed: [] };
  },
  'node.run': (model, input) => (setNodes(model, 'running', input.node), { failed: [] }),
  'node.pause': (model, input) => (setNodes(model, 'paused', input.node), { failed: [] }),
  'node.step': () => ({ failed: [] }),
  'node.stop': (model, input) => (setNodes(model, 'stopped', input.node), { failed: [] }),
  'node.reset': () => ({ failed: [] }),
  'variable.set': (model, input) => {
    const node = [...model.nodes, ...model.crowd].find((one) => one.id === input.node);
    const place = variablesOf(node).find((one) => one.name === input.name);
    input.values.forEach((value, index) =>
      model.written.set(`${input.node} ${(place?.address ?? 0) + input.first + index}`, value),
    );
    return {};
  },
  'define.move': (model, input) => {
    const list = input.kind === 'event' ? model.events : model.constants;
    const at = list.findIndex((one) => one.name === input.name);
    list.splice(input.to, 0, ...list.splice(at, 1));
    return {};
  },
  'node.save': () => ({ failed: [], notes: [] }),
  'target.choose': (model, input) => (
    (model.target = {
      ...model.target,
      target: input.target,
      name: input.target,
      kind: 'bus',
      state: 'connecting',
    }),
    {}
  ),
  'target.leave': (model) => (
    (model.target = { ...model.target, target: '', name: '', kind: 'none', state: 'none' }),
    {}
  ),
  'state.put': (model, input) => (
    (model.values['state'] = {
      ...(model.values['state'] as object),
      [input.key]: input.value,
    }),
    {}
  ),
  'settings.put': (model, input) => (
    (model.settings = { ...model.settings, [input.key]: input.value }),
    {}
  ),
};

export function act(model: Model, command: CommandName, input: unknown, client: number): unknown {
  return ((acts[command] as Act | undefined) ?? (() => ({})))(model, input as never, client);
}

function docOf(model: Model, name: string) {
  const doc = model.docs.get(name);
  if (!doc) throw new Refused({ code: 'not_found', what: `There is no ${name} in the project.` });
  return doc;
}

function languageOf(doc: string): Commands['doc.open']['out']['language'] {
  if (doc.includes('#')) return 'aesl';
  if (doc.endsWith('.plan.json')) return 'plan';
  if (doc.endsWith('.world.json')) return 'world';
  if (doc.endsWith('.aesl')) return 'aesl-file';
  return doc.endsWith('.json') ? 'json' : 'text';
}

function touched(model: Model, doc: string): void {
  if (!doc.includes('#')) return;
  compile(model, doc);
  for (const node of model.nodes) if (node.doc === doc) node.program = 'older';
}

function save(model: Model, name: string): boolean {
  const doc = model.docs.get(name);
  const changed = doc !== undefined && doc.saved !== doc.text;
  if (doc) doc.saved = doc.text;
  return changed;
}

function setNodes(model: Model, state: 'running' | 'paused' | 'stopped', id = 0): void {
  for (const node of [...model.nodes, ...model.crowd])
    if (id === 0 || node.id === id) node.state = state;
}

function escaped(text: string): string {
  return text.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');
}

function patternOf(input: { text: string; regex: boolean; case: boolean; whole: boolean }): RegExp {
  const source = input.regex ? input.text : escaped(input.text);
  return new RegExp(input.whole ? `(?<!\\w)${source}(?!\\w)` : source, input.case ? 'g' : 'gi');
}

function spotsOf(model: Model, doc: string, pattern: RegExp) {
  return (model.docs.get(doc)?.text ?? '').split('\n').flatMap((text, index) =>
    [...text.matchAll(pattern)].map((match) => ({
      doc,
      at: { line: index + 1, column: match.index + 1 },
      end: { line: index + 1, column: match.index + match[0].length + 1 },
      line_text: text.slice(0, 400),
    })),
  );
}

function replaceAll(model: Model, pattern: RegExp, by: string, docs: string[]) {
  const changed: string[] = [];
  let places = 0;
  for (const name of docs) {
    const doc = model.docs.get(name);
    if (!doc || !pattern.test(doc.text)) continue;
    places += [...doc.text.matchAll(pattern)].length;
    doc.text = doc.text.replace(pattern, by);
    doc.version++;
    doc.by = 0;
    touched(model, name);
    changed.push(name);
  }
  return { changed, places };
}

function folderOf(path: string): Commands['folder.list']['out'] {
  const here = path || '/home/you';
  const entries: { name: string; kind: 'folder' | 'project' | 'script' | 'plan' | 'world' }[] = [
    { name: 'Documents', kind: 'folder' },
    { name: 'Vagus', kind: 'folder' },
    { name: 'my-robot', kind: 'project' },
    { name: 'explore.aesl', kind: 'script' },
  ];
  return {
    path: here,
    parent: here.slice(0, here.lastIndexOf('/')) || '/',
    entries: here.split('/').length > 5 ? [] : entries,
  };
}

export type Input = Json;
