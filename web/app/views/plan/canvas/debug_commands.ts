// Looking for mistakes on the canvas: breakpoints, and from an element to its script.

import { placeOf } from '../../../../core/plan/breaks';
import type { Command } from '../../../../core/registry';
import type { Studio } from '../../../../core/studio';
import { revealDoc, toast } from '../../../../core/window_state';
import { canLog, logAt } from '../../../commands/log_values';
import { drives, mayAct } from '../../../commands/looks';
import { text } from '../../../text';
import { drawWords } from '../words';
import { toggleBreak } from '../break_acts';
import { planDeskOf } from '../plan_desk';

const titles = text.commands;

export function debugCommands(studio: Studio, properties: () => void): Command[] {
  const shown = () => planDeskOf(studio).shown;
  /** The row under the keyboard, else what is chosen. */
  const key = () => focusedRow() ?? shown()?.board.selected ?? null;
  const isPlace = () => {
    const board = shown()?.board;
    return drives(studio) && board !== undefined && placeOf(board.model, key()) !== null;
  };
  const logPlace = () => {
    const board = shown()?.board;
    const place = board ? placeOf(board.model, board.selected) : null;
    if (!board || !place || place.kind === 'condition') return null;
    const { element } = place;
    return place.kind === 'event'
      ? ({ is: 'supervisor', doc: board.doc, element, when: 'raise' } as const)
      : ({ is: 'actor', doc: board.doc, element, when: 'enter' } as const);
  };
  const group = text.groups.draw;
  const starts = () => shown()?.board.element(shown()?.board.selected ?? null)?.known?.starts ?? [];
  const plan = () => studio.topics.get('plan', {})?.state;
  return [
    {
      id: 'draw.script',
      title: titles['draw.script'],
      group,
      within: 'plan',
      keys: ['F12'],
      enabled: () => starts().length > 0,
      run: () => goToScript(studio, 'script.handlers', starts()),
    },
    {
      id: 'draw.into',
      title: titles['draw.into'],
      group,
      within: 'plan',
      keys: ['Ctrl+F10'],
      enabled: () =>
        mayAct(studio) && starts().length > 0 && (plan() === 'running' || plan() === 'paused'),
      run: () => goToScript(studio, 'plan.into', starts()),
    },
    {
      id: 'draw.break',
      title: titles['draw.break'],
      group,
      within: 'plan',
      keys: ['F9'],
      enabled: isPlace,
      run() {
        const board = shown()?.board;
        const at = key();
        if (board && at !== null) toggleBreak(studio, board, at);
      },
    },
    {
      id: 'draw.log',
      title: titles['draw.log'],
      group,
      within: 'plan',
      keys: ['Shift+F9'],
      enabled: () => canLog(studio) && logPlace() !== null,
      async run() {
        const place = logPlace();
        if (place) await logAt(studio, place);
      },
    },
    {
      id: 'draw.breakEdit',
      title: titles['draw.breakEdit'],
      group,
      within: 'plan',
      keys: ['Ctrl+F9'],
      enabled: isPlace,
      run() {
        const board = shown()?.board;
        const at = key();
        if (!board || at === null) return;
        board.select(at);
        properties();
      },
    },
  ];
}

/** Opens the first handler of the events by which an element works on a node. */
async function goToScript(
  studio: Studio,
  command: 'script.handlers' | 'plan.into',
  events: string[],
): Promise<void> {
  const { spots } = await studio.send(command, { events });
  const first = spots[0];
  if (first) revealDoc(studio.window, first.doc, first.at);
  else toast(studio.window, 'note', drawWords.noScript(events.join(', ')));
}

function focusedRow(): string | undefined {
  return document.activeElement?.closest<HTMLElement>('[data-plan-port]')?.dataset['planPort'];
}
