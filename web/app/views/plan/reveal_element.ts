import type { Doc } from '../../../protocol/messages';
import type { Studio } from '../../../core/studio';
import { revealDoc } from '../../../core/window_state';
import { planDeskOf } from './plan_desk';

/** Opens a plan and chooses the actor, supervisor or variable of that name in it. */
export function revealElement(studio: Studio, doc: Doc, name: string): void {
  const desk = planDeskOf(studio);
  const show = (): boolean => {
    const shown = desk.find(({ board }) => board.doc === doc);
    if (!shown) return false;
    desk.use(shown);
    const key = shown.board.keyOf(name);
    if (key !== null) {
      shown.board.select(key);
      shown.focus(key);
    }
    return true;
  };
  revealDoc(studio.window, doc, null);
  if (show()) return;
  // Its canvas comes to the desk once it is drawn.
  const end = desk.changed.on(() => {
    if (show()) end();
  });
}
