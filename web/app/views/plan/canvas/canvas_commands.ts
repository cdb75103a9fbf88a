// What can be done on the canvas that is looked at. Keys count while the focus is in it.

import { comparingOf } from '../../../../core/plan/comparing';
import { kStart } from '../../../../core/plan/model';
import type { Command } from '../../../../core/registry';
import type { Studio } from '../../../../core/studio';
import { revealPanel, toast, update } from '../../../../core/window_state';
import { askWhy } from '../../../commands/ask_why';
import { text } from '../../../text';
import { drawWords } from '../words';
import { withBreaks } from '../break_acts';
import { planDeskOf, type ShownPlan } from '../plan_desk';
import { askAt } from '../finding_acts';
import { exportPng, exportSvg } from './export_picture';
import { copyByCommand, cut, hasClipboard, pasteByCommand } from './plan_clipboard';
import { chosenSubPlan, extractChosen, openSubPlan } from './sub_plan_commands';
import { tidy } from './tidy_plan';

const titles = text.commands;
type DrawId = Extract<keyof typeof titles, `draw.${string}`>;

/** The canvas, and what is beside it: the bar above it, the palette, the form of what is chosen. */
const kParts = 'plan-parts';

export interface CanvasActs {
  fit(): void;
  zoom(by: number): void;
  properties(): void;
  rename(): void;
  find(): void;
}

export function canvasCommands(studio: Studio, acts: CanvasActs): Command[] {
  const shown = () => planDeskOf(studio).shown;
  const make = (
    id: DrawId,
    keys: string[],
    run: (plan: ShownPlan) => void | Promise<void>,
    may: (plan: ShownPlan) => boolean = () => true,
    within = 'plan',
  ): Command => ({
    id,
    title: titles[id],
    group: text.groups.draw,
    within,
    keys,
    enabled() {
      const plan = shown();
      return plan !== undefined && may(plan);
    },
    run() {
      const plan = shown();
      return plan && run(plan);
    },
  });
  const edits = () => studio.mayEdit;
  const has = ({ board }: ShownPlan) => edits() && board.selected !== null;
  const named = ({ board }: ShownPlan) =>
    edits() &&
    (board.element(board.selected) ??
      board.variable(board.selected) ??
      board.note(board.selected)) !== undefined;
  const hasPart = ({ board }: ShownPlan) => board.part() !== null;
  const clipboard = (
    id: DrawId,
    key: string,
    run: (plan: ShownPlan) => Promise<void>,
    may: (plan: ShownPlan) => boolean,
  ): Command => ({
    ...make(id, [key], run, (plan) => hasClipboard() && may(plan)),
    keysAreEvents: true,
  });
  const comparing = comparingOf(studio);
  const isCompared = ({ doc }: ShownPlan['board']) => comparing.doc === doc;
  const isActor = ({ board }: ShownPlan) => edits() && board.actor(board.selected) !== undefined;
  const runFrom = () => update(studio.window, (draft) => void (draft.overlay = 'runFrom'));
  return [
    make('draw.runFrom', ['R'], runFrom, (plan) => isActor(plan) && studio.past.at === null),
    make(
      'draw.why',
      ['W'],
      ({ board }) => askWhy(studio, 'actor', board.actor(board.selected)?.name),
      ({ board }) => board.actor(board.selected) !== undefined,
    ),
    {
      ...make(
        'draw.open',
        ['O'],
        (plan) => openSubPlan(studio, plan),
        (plan) => chosenSubPlan(plan) !== null,
      ),
      why: () => drawWords.subPlans.choose,
    },
    make(
      'draw.extract',
      ['Ctrl+Shift+E'],
      (plan) => extractChosen(studio, plan),
      ({ board }) => edits() && board.chosenActors.size > 0,
    ),
    make(
      'draw.connect',
      ['C'],
      ({ board }) => askAt(() => board.nextPort),
      ({ board }) => edits() && board.nextPort !== null,
    ),
    make('draw.add', ['A'], () => revealPanel(studio.window, 'palette'), edits),
    make('draw.fit', ['1'], () => acts.fit()),
    make('draw.find', ['Ctrl+F', '/'], () => acts.find()),
    make(
      'draw.tidy',
      ['T'],
      async (plan) => {
        await tidy(plan);
        acts.fit();
      },
      edits,
    ),
    make('draw.zoomIn', ['+', '='], () => acts.zoom(1.25)),
    make('draw.zoomOut', ['-'], () => acts.zoom(0.8)),
    make(
      'draw.undo',
      ['Ctrl+Z'],
      ({ board }) => void withBreaks(studio, board, () => board.file.undo()),
      ({ board }) => edits() && board.file.canUndo,
      kParts,
    ),
    make(
      'draw.redo',
      ['Ctrl+Y', 'Ctrl+Shift+Z'],
      ({ board }) => void withBreaks(studio, board, () => board.file.redo()),
      ({ board }) => edits() && board.file.canRedo,
      kParts,
    ),
    make(
      'draw.remove',
      ['Delete', 'Backspace'],
      // What is left stays where it is, as long as some of it is seen.
      ({ board, focus }) => focus(board.removeChosen(), { stays: true }),
      has,
    ),
    make('draw.rename', ['F2'], () => acts.rename(), named),
    make(
      'draw.duplicate',
      ['Ctrl+D'],
      ({ board, focus }) => {
        board.duplicate();
        focus(board.selected ?? kStart);
      },
      (plan) => edits() && hasPart(plan),
    ),
    make('draw.all', ['Ctrl+A'], ({ board }) =>
      board.selectAll(board.model.actors.map((one) => one.name)),
    ),
    clipboard('draw.copy', 'Ctrl+C', copyByCommand, hasPart),
    clipboard(
      'draw.cut',
      'Ctrl+X',
      async (plan) => {
        await copyByCommand(plan);
        cut(plan);
      },
      (plan) => edits() && hasPart(plan),
    ),
    clipboard('draw.paste', 'Ctrl+V', (plan) => pasteByCommand(studio, plan), edits),
    make(
      'draw.note',
      ['N'],
      ({ board, middle }) => {
        if (board.addNote(middle()) === null) toast(studio.window, 'error', drawWords.noNotes);
      },
      edits,
    ),
    make('draw.exportSvg', [], (plan) => exportSvg(studio, plan)),
    make('draw.exportPng', [], (plan) => exportPng(studio, plan)),
    make('draw.variable', [], ({ board }) => void board.addVariable(), edits),
    make(
      'draw.properties',
      ['Enter'],
      ({ board }) => (board.note(board.selected) && edits() ? acts.rename() : acts.properties()),
      ({ board }) => board.selected !== null,
    ),
    make(
      'draw.none',
      ['Escape'],
      // A comparison is left first, with what is chosen in it.
      ({ board }) => {
        if (isCompared(board)) comparing.leave();
        board.select(null);
      },
      ({ board }) => board.selected !== null || isCompared(board),
    ),
  ];
}
