// What this page did by hand in the world of a run is undone and kept after a reload, too.

import { deskFor } from '../../../core/desk';
import type { Studio } from '../../../core/studio';
import type { Hand } from '../../../core/world/hand';

const kKey = 'vagus.hand';

/** That of the page, with what it did before it was loaded again. */
export const keptHand: (studio: Studio) => Hand = deskFor(({ hand }: Studio) => {
  hand.restore(sessionStorage.getItem(kKey));
  // A tab that is duplicated has done nothing by hand.
  sessionStorage.removeItem(kKey);
  addEventListener('pagehide', () => keep(hand.text()));
  return hand;
});

function keep(text: string): void {
  try {
    sessionStorage.setItem(kKey, text);
  } catch {
    // The browser keeps no more than some megabytes: nothing can be undone after the reload.
    sessionStorage.removeItem(kKey);
  }
}
