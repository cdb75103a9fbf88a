import { IconAlertOctagon, IconAlertTriangle } from '@tabler/icons-react';
import type { Counts } from '../../../../core/findings';
import { drawWords } from '../words';

/** What the checker has found at an element: an octagon or a triangle, with the number. */
export function Mark({ errors, warnings }: Counts) {
  if (errors + warnings === 0) return null;
  const isError = errors > 0;
  const Icon = isError ? IconAlertOctagon : IconAlertTriangle;
  return (
    <span
      className={isError ? 'pmark' : 'pmark pmark--warning'}
      role="img"
      aria-label={drawWords.findings(errors, warnings)}
    >
      <Icon size={13} stroke={2} aria-hidden />
      {isError ? errors : warnings}
    </span>
  );
}
