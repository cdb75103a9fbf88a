import type { Command } from '../../core/registry';
import type { Studio } from '../../core/studio';
import { answers } from '../../core/connection';
import { runStateOf } from '../../core/run_state';
import { toast } from '../../core/window_state';
import type { Failed, NodeId } from '../../protocol/messages';
import { takeFocus } from '../parts/take_focus';
import { text } from '../text';
import { runRobot } from './run_robot';
import { clockOf, drives, mayAct, projectOf, robotOf, shownNode } from './looks';

const titles = text.commands;
const group = text.groups.run;

/** Run, pause, step and stop: of the whole robot by keys, of one node by its tab. */
export function runCommands(studio: Studio): Command[] {
  const may = () => mayAct(studio) && projectOf(studio) !== null;
  const state = () => runStateOf(robotOf(studio), clockOf(studio), studio.topics.get('plan', {}));
  return [
    {
      id: 'run.stop',
      title: titles['run.stop'],
      group,
      keys: ['Shift+F5'],
      // Always: also for those who only look.
      run: async () => void (await studio.stopping.press()),
    },
    {
      id: 'run.start',
      title: titles['run.start'],
      group,
      keys: ['F5'],
      enabled: may,
      run: () => runRobot(studio),
    },
    {
      id: 'run.pause',
      title: titles['run.pause'],
      group,
      keys: ['F8'],
      enabled: () => may() && state() === 'running',
      run: async () => void (await studio.sendInTurn('run.pause', {})),
    },
    {
      id: 'run.step',
      title: titles['run.step'],
      group,
      keys: ['F10'],
      enabled: () => may() && state() === 'held',
      run: () => step(studio),
    },
    {
      id: 'run.reset',
      title: titles['run.reset'],
      group,
      enabled: () => may() && robotOf(studio)?.kind === 'simulator',
      run: async () => void (await studio.sendInTurn('run.reset', {})),
    },
    {
      id: 'run.speed',
      title: `${text.menu.speed}…`,
      group,
      enabled: () => clockButton() !== null,
      run: () =>
        takeFocus(() => {
          clockButton()?.focus();
          clockButton()?.click();
          return true;
        }),
    },
    {
      id: 'run.end',
      title: titles['run.end'],
      group,
      enabled: () => drives(studio) && clockOf(studio)?.state === 'hanging',
      run: async () => void (await studio.send('run.end', {})),
    },
    {
      id: 'target.leave',
      title: titles['target.leave'],
      group,
      enabled: () => drives(studio) && (robotOf(studio)?.kind ?? 'none') !== 'none',
      run: async () => void (await studio.send('target.leave', {})),
    },
    {
      id: 'driver.ask',
      title: titles['driver.ask'],
      group,
      enabled: () => answers(studio.connection.link) && !drives(studio),
      run: async () => void (await studio.send('driver.ask', {})),
    },
  ];
}

/** Its menu has the speeds. */
const clockButton = () => document.querySelector<HTMLElement>('button.clock');

/** For the node whose script is looked at. */
export function nodeCommands(studio: Studio): Command[] {
  const has = () => shownNode(studio) !== undefined;
  const some = () => (robotOf(studio)?.nodes.length ?? 0) > 0;
  const may = (act: NodeAct) => (act === 'stop' ? drives(studio) : mayAct(studio));
  const order = (act: 'run' | 'pause' | 'step' | 'stop' | 'reset'): Command => ({
    id: `node.${act}`,
    title: titles[`node.${act}`],
    group,
    enabled: () => may(act) && has(),
    run: async () => {
      const node = shownNode(studio)?.id ?? 0;
      reportFailed(studio, (await studio.sendInTurn(`node.${act}`, { node }))?.failed ?? []);
    },
  });
  return [
    {
      id: 'node.load',
      title: titles['node.load'],
      group,
      keys: ['Alt+Shift+U'],
      enabled: () => may('load') && some(),
      run: () => load(studio, shownNode(studio)?.id ?? 0),
    },
    {
      id: 'node.loadAll',
      title: titles['node.loadAll'],
      group,
      enabled: () => may('load') && some(),
      run: () => load(studio, 0),
    },
    {
      id: 'node.save',
      title: titles['node.save'],
      group,
      enabled: () => may('save') && has(),
      run: () => keep(studio),
    },
    order('run'),
    order('pause'),
    order('step'),
    order('stop'),
    order('reset'),
    ...nodeActs.flatMap((act): Command[] => {
      const id = allOf[act];
      return id
        ? [
            {
              id,
              title: titles[id],
              group,
              enabled: () => may(act) && some(),
              run: () => orderNodes(studio, act, []),
            },
          ]
        : [];
    }),
  ];
}

export const nodeActs = ['run', 'pause', 'step', 'stop', 'reset', 'load', 'save'] as const;
export type NodeAct = (typeof nodeActs)[number];

/** Uploading to all has a command of its own. */
const allOf: Record<NodeAct, keyof typeof titles | null> = {
  run: 'node.runAll',
  pause: 'node.pauseAll',
  step: 'node.stepAll',
  stop: 'node.stopAll',
  reset: 'node.resetAll',
  load: null,
  save: 'node.saveAll',
};

/** Does it with some nodes, or with all if none is named; says which of them did not do it. */
export async function orderNodes(
  studio: Studio,
  act: NodeAct,
  nodes: readonly NodeId[],
): Promise<void> {
  const ready: Promise<unknown> = act === 'load' ? studio.documents.flushAll() : Promise.resolve();
  const answers = await studio.inTurn(ready, (_, due) =>
    Promise.all(
      (nodes.length > 0 ? nodes : [0]).map((node) => studio.send(`node.${act}`, { node }, due)),
    ),
  );
  if (answers === null) return;
  for (const answer of answers) {
    reportFailed(studio, answer.failed);
    if ('notes' in answer) for (const note of answer.notes) toast(studio.window, 'note', note.what);
  }
  const good = answers.every((answer) => answer.failed.length === 0);
  if (good && act === 'save') toast(studio.window, 'ok', text.editor.keptAll(nodes.length));
  if (good && act === 'load') toast(studio.window, 'ok', text.editor.loadedAll(loadedIn(answers)));
}

function loadedIn(answers: readonly object[]): number {
  return answers.reduce(
    (sum, answer) =>
      sum + ('loaded' in answer && Array.isArray(answer.loaded) ? answer.loaded.length : 0),
    0,
  );
}

// A node that is at a line goes to its next line; else the whole simulation goes on by an instant.
async function step(studio: Studio): Promise<void> {
  const standing =
    robotOf(studio)?.nodes.filter((node) => node.state === 'paused' && node.at) ?? [];
  if (standing.length === 0) return void (await studio.sendInTurn('run.step', {}));
  const shown = standing.find((node) => node.id === shownNode(studio)?.id);
  const node = shown?.id ?? standing[0]?.id ?? 0;
  reportFailed(studio, (await studio.sendInTurn('node.step', { node }))?.failed ?? []);
}

async function load(studio: Studio, node: number): Promise<void> {
  const answer = await studio.inTurn(studio.documents.flushAll(), (_, due) =>
    studio.send('node.load', { node }, due),
  );
  if (answer === null) return;
  const { loaded, failed } = answer;
  reportFailed(studio, failed);
  const name = robotOf(studio)?.nodes.find((one) => one.id === loaded[0])?.name;
  if (name && loaded.length === 1) toast(studio.window, 'ok', text.editor.loaded(name));
  else if (loaded.length > 0) toast(studio.window, 'ok', text.editor.loadedAll(loaded.length));
}

async function keep(studio: Studio): Promise<void> {
  const { failed, notes } = await studio.send('node.save', { node: shownNode(studio)?.id ?? 0 });
  reportFailed(studio, failed);
  for (const note of notes) toast(studio.window, 'note', note.what);
  if (failed.length === 0) toast(studio.window, 'ok', text.editor.kept);
}

/** So many reasons in full: a robot of a hundred nodes must not fill the window with them. */
const kReasonsShown = 3;

function reportFailed(studio: Studio, failed: readonly Failed[]): void {
  for (const { node, why } of failed.slice(0, kReasonsShown)) {
    const name = robotOf(studio)?.nodes.find((one) => one.id === node)?.name ?? String(node);
    toast(studio.window, 'error', `${name}: ${why}`);
  }
  const more = failed.length - kReasonsShown;
  if (more > 0) toast(studio.window, 'error', text.editor.moreFailed(more));
}
