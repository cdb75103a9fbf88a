// What helps with a finding of a plan that no edit of a text can fix: an arrow to draw, a value to type.

import { arrowId } from '../../../core/plan/arrows';
import { kStart } from '../../../core/plan/model';
import { wantedBy } from '../../../core/plan/row_findings';
import type { Studio } from '../../../core/studio';
import { revealPanel } from '../../../core/window_state';
import type { Finding } from '../../../protocol/messages';
import type { DrawnHelp, FindingAct } from '../../commands/problem_commands';
import { takeFocus } from '../../parts/take_focus';
import { text } from '../../text';
import { planDeskOf } from './plan_desk';
import { revealElement } from './reveal_element';

/** What Alt+Enter does for the findings of drawings. */
export const drawnHelp = (studio: Studio): DrawnHelp => ({
  actFor: (finding) => actFor(studio, finding),
  isChosen({ doc, element }) {
    const board = planDeskOf(studio).shown?.board;
    if (board?.doc !== doc || board.selected === null || element === undefined) return false;
    return board.keyOf(element) === board.selected;
  },
});

/** The button for it; null if nothing but its fixes helps. */
export function actFor(studio: Studio, finding: Finding): FindingAct | null {
  const wanted = wantedBy(finding);
  if (wanted === null) return null;
  const { doc, element = '' } = finding;
  if (wanted.is !== 'arrow')
    return {
      label: wanted.is === 'value' ? text.problems.enterValue : text.problems.correctValue,
      run() {
        revealElement(studio, doc, element, false);
        revealPanel(studio.window, 'properties', false);
        focusOn(`[data-plan-input="${CSS.escape(`${element}.${wanted.name}`)}"]`);
      },
    };
  return {
    label: text.problems.connectIt,
    run() {
      revealElement(studio, doc, element, false);
      const port = () => {
        const { shown } = planDeskOf(studio);
        if (shown?.board.doc !== doc) return null;
        const source = element === '' ? kStart : shown.board.keyOf(element);
        return source === null ? null : arrowId(source, wanted.name);
      };
      askAt(port);
    },
  };
}

/** The list of what may follow, at the port where the arrow begins. */
export function askAt(port: () => string | null): void {
  takeFocus(() => {
    const id = port();
    const found = id === null ? null : shown(`[data-plan-port="${CSS.escape(id)}"]`);
    if (!found) return false;
    // The port has the focus again once something was chosen.
    found.focus();
    found.dispatchEvent(new KeyboardEvent('keydown', { key: 'Enter', bubbles: true }));
    return true;
  });
}

function focusOn(selector: string): void {
  takeFocus(() => {
    const found = shown(selector);
    found?.focus();
    return found !== null;
  });
}

function shown(selector: string): HTMLElement | null {
  const found = document.querySelector<HTMLElement>(selector);
  return found !== null && found.offsetParent !== null ? found : null;
}
