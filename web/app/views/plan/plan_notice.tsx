import { IconAlertTriangle, IconArrowsExchange } from '@tabler/icons-react';
import type { ReactNode } from 'react';
import { kStroke } from '../../parts/icons';

/** A box above the drawing that says what a change of the plan means; `end` is what can be done about it. */
export function PlanNotice(props: { good?: boolean; end: ReactNode; children: ReactNode }) {
  const { good = true, end, children } = props;
  const Icon = good ? IconArrowsExchange : IconAlertTriangle;
  return (
    <div className="notice planchange" role="status">
      <Icon className="icon" size={14} stroke={kStroke} aria-hidden />
      <div className="grow">{children}</div>
      {end}
    </div>
  );
}
