import { useSyncExternalStore } from 'react';

// Too narrow for panels on both sides of a document, or too low for panels below it.
const query = matchMedia('(max-width: 900px), (max-height: 560px)');

function subscribe(listener: () => void): () => void {
  query.addEventListener('change', listener);
  return () => query.removeEventListener('change', listener);
}

/** Whether the panels share one column beside the documents; so they do at a zoom of 200 %, too. */
export function useSmall(): boolean {
  return useSyncExternalStore(subscribe, () => query.matches);
}
