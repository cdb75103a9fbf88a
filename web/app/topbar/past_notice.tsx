import { useEffect } from 'react';
import { late } from '../parts/late';
import { usePastTime } from '../past_hooks';

const PastBar = late(() => import('./past_bar'), 'button');

/** Past is never mistaken for now. */
export function PastNotice() {
  const at = usePastTime();
  useEffect(() => {
    document.documentElement.toggleAttribute('data-past', at !== null);
  }, [at]);
  return at === null ? null : <PastBar at={at} />;
}
