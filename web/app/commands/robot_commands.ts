// Variables, events, plots and nodes: what can be done with them by a command.

import { pickKey, type Pick } from '../../core/picks';
import { sourceKey, sourcesOf, withCurve, withoutCurve, type Source } from '../../core/plot';
import type { Command } from '../../core/registry';
import type { Studio } from '../../core/studio';
import { revealPanel, updateEvents } from '../../core/window_state';
import { takeFocus } from '../parts/take_focus';
import { text } from '../text';
import { copyText } from './clipboard';
import { download } from './download';
import { projectOf, robotOf, drives } from './looks';

const titles = text.commands;
const group = text.groups.robot;

export function robotCommands(studio: Studio): Command[] {
  const open = () => projectOf(studio) !== null;
  const plotted = () => studio.plotter.state.curves.length > 0;
  const heard = () => studio.happenings.items.length > 0;
  const hasRobot = () => (robotOf(studio)?.kind ?? 'none') !== 'none';
  return [
    command('variables.find', open, () => find(studio, 'variables'), ['Alt+Shift+V']),
    command('watch.add', open, () => find(studio, 'watch'), ['Alt+Shift+W']),
    command(
      'watch.clear',
      () => studio.watched.list.length > 0,
      () => studio.watched.set([]),
    ),
    command('events.find', open, () => find(studio, 'events'), ['Alt+Shift+E']),
    command('events.pause', open, () => pauseEvents(studio)),
    command('events.clear', heard, () => studio.happenings.clear()),
    // Whoever has not looked at them yet does not know whether there are any.
    command(
      'events.csv',
      () => heard() || hasRobot(),
      async () => (await import('./save_events')).saveEvents(studio),
    ),
    command(
      'events.send',
      () => drives(studio) && hasRobot(),
      () => openSend(studio),
      ['Alt+Shift+S'],
    ),
    command('plots.add', open, () => find(studio, 'plots'), ['Alt+Shift+P']),
    command('plots.pause', plotted, () => studio.plotter.pause(!studio.plotter.paused)),
    command('plots.fit', plotted, () => studio.plotter.zoom(null)),
    command('plots.clear', plotted, () =>
      studio.plotter.set({ ...studio.plotter.state, curves: [] }),
    ),
    command('plots.csv', plotted, () => copyCsv(studio)),
    command('plots.csvFile', plotted, () => download(csvBlob(studio.plotter.csv()), 'plot.csv')),
    command('plots.png', plotted, async () => (await import('./plot_pictures')).copyPng(studio)),
    command('plots.pngFile', plotted, async () =>
      (await import('./plot_pictures')).savePng(studio),
    ),
  ];
}

function command(
  id: keyof typeof titles,
  enabled: () => boolean,
  run: () => void | Promise<void>,
  keys?: string[],
): Command {
  return { id, title: titles[id], group, enabled, run, ...(keys ? { keys } : {}) };
}

/** Into the plot, or out of it if it is there. The whole of an array goes in as its first elements. */
export function plotPick(studio: Studio, pick: Pick, size: number): void {
  const { plotter } = studio;
  const key = pickKey(pick);
  const own = plotter.state.curves.filter(({ source }) => {
    const other = sourceKey(source);
    return other === key || (pick.index === undefined && other.startsWith(`${key}[`));
  });
  if (own.length > 0)
    plotter.set(own.reduce((plot, { source }) => withoutCurve(plot, source), plotter.state));
  else addToPlot(studio, sourcesOf(pick, size));
}

export function addToPlot(studio: Studio, sources: readonly Source[]): void {
  const { plotter } = studio;
  plotter.set(sources.reduce((plot, source) => withCurve(plot, source), plotter.state));
  revealPanel(studio.window, 'plots', false);
}

/** The panel, with the focus in the field that finds or adds. */
function find(studio: Studio, panel: 'variables' | 'watch' | 'events' | 'plots'): void {
  revealPanel(studio.window, panel, false);
  focusFind(panel);
}

/** The panel may have to be loaded first. */
function focusFind(panel: string): void {
  takeFocus(() => {
    const field = document.querySelector<HTMLElement>(`[data-find="${panel}"]`);
    if (!field || field.offsetParent === null) return false;
    field.focus();
    return true;
  });
}

function pauseEvents(studio: Studio): void {
  updateEvents(studio.window, { paused: !studio.window.getState().events.paused });
}

function openSend(studio: Studio): void {
  updateEvents(studio.window, { send: true });
  revealPanel(studio.window, 'events', false);
}

async function copyCsv(studio: Studio): Promise<void> {
  await copyText(studio, studio.plotter.csv(), text.clipboard.copied('CSV'));
}

function csvBlob(csv: string): Blob {
  return new Blob([csv], { type: 'text/csv' });
}
