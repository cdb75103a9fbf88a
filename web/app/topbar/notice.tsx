import type { ReactNode } from 'react';

/** A line of the notices: what it is about, and what can be done. */
export function Notice({
  icon,
  error,
  children,
  end,
}: {
  icon: ReactNode;
  error?: boolean;
  children: ReactNode;
  end?: ReactNode;
}) {
  return (
    <div className={error ? 'notice notice--error' : 'notice'} role="status">
      {icon}
      <span className="ellipsis">{children}</span>
      <span className="grow" />
      {end}
    </div>
  );
}
