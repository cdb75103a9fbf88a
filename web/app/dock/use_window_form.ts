import { useSyncExternalStore } from 'react';

export type WindowForm = 'large' | 'small' | 'tall';

// Too narrow for panels on both sides of a document, or too low for panels below it.
const small = matchMedia('(max-width: 900px), (max-height: 560px)');
const tall = matchMedia('(max-width: 900px) and (min-height: 900px)');

function subscribe(listener: () => void): () => void {
  for (const query of [small, tall]) query.addEventListener('change', listener);
  return () => {
    for (const query of [small, tall]) query.removeEventListener('change', listener);
  };
}

const formNow = (): WindowForm => (tall.matches ? 'tall' : small.matches ? 'small' : 'large');

/** Where panels have room beside the documents: so little is there at a zoom of 200 %, too. */
export function useWindowForm(): WindowForm {
  return useSyncExternalStore(subscribe, formNow);
}
