import { Tooltip } from '@mantine/core';
import type { ButtonHTMLAttributes, ReactNode } from 'react';
import { Kbd } from './kbd';

export interface ButtonProps extends ButtonHTMLAttributes<HTMLButtonElement> {
  kind?: 'normal' | 'primary' | 'plain';
  small?: boolean;
  /** The name of a button that shows only an icon; shown as a tip. */
  tip?: string;
  keys?: string | undefined;
  icon?: ReactNode;
}

/** A button with an icon, a text, or both; one without text says its name in a tip. */
export function Button({
  kind = 'normal',
  small,
  tip,
  keys,
  icon,
  children,
  className,
  ...rest
}: ButtonProps) {
  const classes = ['btn'];
  if (kind !== 'normal') classes.push(`btn--${kind}`);
  if (small) classes.push('btn--small');
  if (children === undefined) classes.push('btn--icon');
  if (className) classes.push(className);
  const button = (
    <button
      type="button"
      className={classes.join(' ')}
      aria-label={children === undefined ? tip : undefined}
      {...rest}
    >
      {icon}
      {children}
      {children !== undefined && keys ? <Kbd keys={keys} /> : null}
    </button>
  );
  if (!tip) return button;
  return (
    <Tip label={tip} keys={keys}>
      {button}
    </Tip>
  );
}

export function Tip({
  label,
  keys,
  children,
}: {
  label: string;
  keys?: string | undefined;
  children: ReactNode;
}) {
  return (
    <Tooltip
      label={keys ? `${label}  (${keys})` : label}
      openDelay={400}
      classNames={{ tooltip: 'tip' }}
      withinPortal
      events={{ hover: true, focus: true, touch: false }}
    >
      {children as React.ReactElement}
    </Tooltip>
  );
}
