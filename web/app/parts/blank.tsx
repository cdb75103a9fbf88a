import type { ReactNode } from 'react';

/** What a panel shows when it has nothing: what to do. */
export function Blank({
  icon,
  title,
  children,
}: {
  icon?: ReactNode;
  title?: string;
  children?: ReactNode;
}) {
  return (
    <div className="blank">
      {icon}
      <div>
        {title ? <b>{title}</b> : null}
        {typeof children === 'string' ? <p>{children}</p> : children}
      </div>
    </div>
  );
}

export function Quiet({ children }: { children: ReactNode }) {
  return <p className="quiet">{children}</p>;
}
