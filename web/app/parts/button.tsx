import type { ButtonHTMLAttributes, ReactNode } from 'react';
import { Kbd } from './kbd';
import { keysShown } from './keys_shown';

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
  return (
    <button
      type="button"
      className={classes.join(' ')}
      aria-label={children === undefined ? tip : undefined}
      {...tipOf(tip, keys)}
      {...rest}
    >
      {icon}
      {children}
      {children !== undefined && keys ? <Kbd keys={keys} /> : null}
    </button>
  );
}

/** What overlay/tips.tsx shows beside an element that has these attributes. */
export function tipOf(label: string | undefined, keys?: string): { 'data-tip'?: string } {
  if (!label) return {};
  return { 'data-tip': keys ? `${label}  (${keysShown(keys)})` : label };
}
