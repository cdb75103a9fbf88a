// A plan that is paused, at a breakpoint or after a step, comes to the front: the innermost one, with its active actor in
// sight. The keyboard stays where it is. Whoever pauses it while a script is in front goes on with that.

import { TabSetNode, type Model } from 'flexlayout-react';
import { useEffect, useEffectEvent, useRef } from 'react';
import { pausedPlace, pausedStep } from '../../core/plan/paused';
import { revealDoc, update } from '../../core/window_state';
import { usePart, useStudio } from '../hooks';
import { showElement } from '../views/plan/reveal_element';
import { kindOf } from '../documents';
import { areaFor } from './model';

export function usePausedPlan(model: Model | null): void {
  const studio = useStudio();
  const step = usePart('plan', {}, pausedStep);
  const before = useRef('');
  const show = useEffectEvent((ran: boolean) => {
    const plan = studio.topics.get('plan', {});
    const place = pausedPlace(plan);
    // Nothing has stopped it but a person.
    const isAsked = ran && (plan?.stands_at ?? []).length === 0;
    if (!model || !place || isInTheWay(model, place.doc, isAsked)) return;
    const { doc, actor, caller } = place;
    if (caller !== null && caller !== doc)
      update(studio.window, (draft) => void (draft.callers = { ...draft.callers, [doc]: caller }));
    revealDoc(studio.window, doc, null, false);
    return showElement(studio, doc, actor);
  });
  const isReady = model !== null;
  useEffect(() => {
    const ran = before.current === '';
    before.current = step;
    return isReady && step !== '' ? show(ran) : undefined;
  }, [isReady, step]);
}

/**
 * Where the plan would come to the front there is another document: one that is looked at by whoever has paused
 * the plan, or with a field in which somebody writes.
 */
function isInTheWay(model: Model, doc: string, isAsked: boolean): boolean {
  const tab = model.getNodeById(`doc:${doc}`);
  const area = tab?.getParent() ?? areaFor(model, 'plan');
  const shown = area instanceof TabSetNode ? area.getSelectedNode() : undefined;
  if (!shown || shown === tab) return false;
  const other = shown.getId().startsWith('doc:') ? shown.getId().slice(4) : null;
  if (isAsked && other !== null && kindOf(other) !== 'plan') return true;
  const field = document.activeElement;
  const isField = field?.matches('input, textarea, select, [contenteditable="true"]');
  return (
    isField === true && field?.closest(`[data-tab-content="${CSS.escape(shown.getId())}"]`) !== null
  );
}
