import { useSyncExternalStore } from 'react';
import { isPhone, kPhone } from '../is_phone';

function subscribe(listener: () => void): () => void {
  const query = matchMedia(kPhone);
  query.addEventListener('change', listener);
  return () => query.removeEventListener('change', listener);
}

/** Whether this window is that of a telephone; turning or widening it changes that. */
export function usePhone(): boolean {
  return useSyncExternalStore(subscribe, isPhone);
}
