// Looking for mistakes on the canvas: breakpoints, and from an element to its script.

import { placeOf } from '../../../../core/plan/breaks';
import type { Command } from '../../../../core/registry';
import type { Studio } from '../../../../core/studio';
import { drives } from '../../../commands/looks';
import { text } from '../../../text';
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
  const group = text.groups.draw;
  return [
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

function focusedRow(): string | undefined {
  return document.activeElement?.closest<HTMLElement>('[data-plan-port]')?.dataset['planPort'];
}
