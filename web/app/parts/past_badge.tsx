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
    // Drawn by its style: the name of a tab stays the name of what it shows.
    <span className="pastbadge" data-time={`${shownTime(at)} s`}>
      <IconHistory className="icon" size={12} stroke={kStroke} aria-hidden />
    </span>
  );
}
