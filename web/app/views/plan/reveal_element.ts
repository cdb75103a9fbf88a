import type { Doc } from '../../../protocol/messages';
import type { Studio } from '../../../core/studio';
import { revealDoc } from '../../../core/window_state';
import { planDeskOf, type ShownPlan } from './plan_desk';

/**
 * Opens a plan and chooses the actor, supervisor or variable of that name in it. It gets the keyboard, unless that goes
 * to something else of the element.
 */
export function revealElement(studio: Studio, doc: Doc, name: string, takesFocus = true): void {
  const desk = planDeskOf(studio);
  revealDoc(studio.window, doc, null, takesFocus);
  onceDrawn(studio, doc, (shown) => {
    desk.use(shown);
    const key = shown.board.keyOf(name);
    if (key === null) return;
    shown.board.select(key);
    if (takesFocus) shown.focus(key);
    else shown.show(key);
  });
}

/** An element of a plan that is open comes in sight; what is chosen and the keyboard stay. Gives what ends the wait. */
export function showElement(studio: Studio, doc: Doc, name: string): () => void {
  return onceDrawn(studio, doc, (shown) => {
    const key = shown.board.keyOf(name);
    if (key !== null) shown.show(key);
  });
}

/** A canvas comes to the desk once it is drawn. */
function onceDrawn(studio: Studio, doc: Doc, act: (shown: ShownPlan) => void): () => void {
  const desk = planDeskOf(studio);
  const attempt = (): boolean => {
    const shown = desk.find(({ board }) => board.doc === doc);
    if (shown) act(shown);
    return shown !== undefined;
  };
  if (attempt()) return () => {};
  const end = desk.changed.on(() => {
    if (attempt()) end();
  });
  return end;
}
