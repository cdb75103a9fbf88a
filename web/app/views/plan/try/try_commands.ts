import { arrowId, supervisorKey } from '../../../../core/plan/arrows';
import type { Doc } from '../../../../protocol/messages';
import type { PlanBoard } from '../../../../core/plan/board';
import { supervisorsOf } from '../../../../core/plan/model';
import { tryingOf, type Option, type Trying } from '../../../../core/plan/trying';
import type { Command } from '../../../../core/registry';
import type { Studio } from '../../../../core/studio';
import { revealDoc } from '../../../../core/window_state';
import { kindOf } from '../../../documents';
import { useChanges, useStudio } from '../../../hooks';
import { text } from '../../../text';
import { hearDigits } from './digits';
import { tryWords as words } from './words';

export function tryCommands(studio: Studio): Command[] {
  const doc = () => studio.window.getState().doc ?? '';
  return [
    {
      id: 'view.try',
      title: words.command,
      group: text.groups.draw,
      enabled: () => kindOf(doc()) === 'plan',
      why: () => words.noPlan,
      run: () => tryPlan(studio, doc()),
    },
  ];
}

/** Shown in place of what runs, now: of the past nothing is shown then. */
export function tryPlan(studio: Studio, doc: Doc): void {
  studio.past.back();
  const trying = tryingOf(studio);
  trying.start(doc);
  // In a small window a panel may be in front of it.
  revealDoc(studio.window, doc, null, false);
  hearDigits(trying);
}

/** Chooses what was clicked in the drawing of a plan that is tried; false: it is nothing to choose. null: none is tried. */
export function useTriedClick(
  board: PlanBoard,
): ((event: React.MouseEvent, node: string) => boolean) | null {
  const trying = tryingOf(useStudio());
  useChanges(trying.changed);
  const { plan } = trying.answer ?? {};
  if (!plan?.levels.some(({ doc }) => doc === board.doc)) return null;
  return ({ target }, node) => {
    const option = clickedOption(trying, board, target, node);
    if (option === undefined) return false;
    void trying.choose(option);
    trying.clicked.emit();
    return true;
  };
}

/** What a click in the drawing chooses: a row of the active actor, a supervisor that watches; undefined: nothing. */
function clickedOption(
  trying: Trying,
  board: PlanBoard,
  target: EventTarget | null,
  node: string,
): Option | undefined {
  const row = target instanceof Element ? target.closest<HTMLElement>('[data-plan-row]') : null;
  const key = row?.dataset['planRow'] ?? node;
  const { plan } = trying.answer ?? {};
  const paths = (plan?.levels ?? []).flatMap(({ doc, path }) => (doc === board.doc ? path : []));
  const found = trying.options.filter((one) => {
    const source = sourceOf(board, one);
    return paths.includes(one.path) && (arrowId(source, one.outcome) === key || source === key);
  });
  // A click on an actor chooses it; one on a supervisor with one event raises that.
  const isState = found[0]?.is === 'state' && row === null;
  return found.length === 1 && !isState ? found[0] : undefined;
}

function sourceOf(board: PlanBoard, { is, element }: Option): string {
  if (is === 'state') return element;
  const supervisor = supervisorsOf(board.model).find(({ name }) => name === element);
  return supervisor ? supervisorKey(supervisor) : '';
}
