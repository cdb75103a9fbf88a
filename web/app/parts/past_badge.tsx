import { IconHistory } from '@tabler/icons-react';
import { shownTime } from '../../core/numbers';
import { usePastTime } from '../past_hooks';
import { kStroke } from './icons';
import '../look/timeline.css';

/** Beside what shows an instant of the past: which. */
export function PastBadge() {
  const at = usePastTime();
  if (at === null) return null;
  return (
    <span className="pastbadge num">
      <IconHistory className="icon" size={12} stroke={kStroke} aria-hidden />
      {shownTime(at)} s
    </span>
  );
}
