import type { Doc } from '../../../../protocol/messages';
import { comparingOf, type Other } from '../../../../core/plan/comparing';
import type { Command } from '../../../../core/registry';
import type { Studio } from '../../../../core/studio';
import { revealDoc } from '../../../../core/window_state';
import { kindOf } from '../../../documents';
import { text } from '../../../text';
import { compareWords as words } from './words';

const group = text.groups.draw;

export function compareCommands(studio: Studio): Command[] {
  const comparing = comparingOf(studio);
  const doc = () => studio.window.getState().doc;
  const isShown = () => comparing.doc !== null && comparing.doc === doc();
  const why = () => (isShown() ? words.none : words.notCompared);
  const steps = (by: 1 | -1) => ({
    group,
    why,
    enabled: () => isShown() && (comparing.answer?.differences.length ?? 0) > 0,
    run: () => comparing.step(by),
  });
  return [
    {
      id: 'view.compare',
      title: words.commands.compare,
      group,
      enabled: () => kindOf(doc() ?? '') === 'plan',
      why: () => words.noPlan,
      run: () => comparing.open(doc()),
    },
    { id: 'view.nextDifference', title: words.commands.next, keys: ['F7'], ...steps(1) },
    {
      id: 'view.previousDifference',
      title: words.commands.previous,
      keys: ['Shift+F7'],
      ...steps(-1),
    },
    {
      id: 'view.leaveDifferences',
      title: words.commands.leave,
      group,
      enabled: isShown,
      why,
      run: () => comparing.leave(),
    },
  ];
}

/** Draws what differs, from wherever that is asked. */
export function showDifferences(studio: Studio, doc: Doc, other: Other): void {
  revealDoc(studio.window, doc, null);
  comparingOf(studio).compare(doc, other);
}
