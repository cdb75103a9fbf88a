// A plan that is paused, at a breakpoint or after a step, comes to the front: the innermost one, with its active actor in
// sight. The keyboard stays where it is.

import { TabSetNode, type Model } from 'flexlayout-react';
import { useEffect, useEffectEvent } from 'react';
import { pausedPlace, pausedStep } from '../../core/plan/paused';
import { revealDoc, update } from '../../core/window_state';
import { usePart, useStudio } from '../hooks';
import { showElement } from '../views/plan/reveal_element';
import { areaFor } from './model';

export function usePausedPlan(model: Model | null): void {
  const studio = useStudio();
  const step = usePart('plan', {}, pausedStep);
  const show = useEffectEvent(() => {
    const place = pausedPlace(studio.topics.get('plan', {}));
    if (!model || !place || isWrittenOver(model, place.doc)) return;
    const { doc, actor, caller } = place;
    if (caller !== null && caller !== doc)
      update(studio.window, (draft) => void (draft.callers = { ...draft.callers, [doc]: caller }));
    revealDoc(studio.window, doc, null, false);
    return showElement(studio, doc, actor);
  });
  const isReady = model !== null;
  useEffect(() => (isReady && step !== '' ? show() : undefined), [isReady, step]);
}

/** Where the plan would come to the front there is another document with a field in which somebody writes. */
function isWrittenOver(model: Model, doc: string): boolean {
  const tab = model.getNodeById(`doc:${doc}`);
  const area = tab?.getParent() ?? areaFor(model, 'plan');
  const shown = area instanceof TabSetNode ? area.getSelectedNode() : undefined;
  if (!shown || shown === tab) return false;
  const field = document.activeElement;
  const isField = field?.matches('input, textarea, select, [contenteditable="true"]');
  return (
    isField === true && field?.closest(`[data-tab-content="${CSS.escape(shown.getId())}"]`) !== null
  );
}
