import { useSyncExternalStore } from 'react';

// Narrower than any window in which panels can be beside each other.
const kPhone = '(max-width: 600px)';

function subscribe(listener: () => void): () => void {
  const query = matchMedia(kPhone);
  query.addEventListener('change', listener);
  return () => query.removeEventListener('change', listener);
}

/** Whether this window is that of a telephone; turning or widening it changes that. */
export function usePhone(): boolean {
  return useSyncExternalStore(subscribe, () => matchMedia(kPhone).matches);
}
