import { Popover, type PopoverProps } from '@mantine/core';
import type { ReactNode } from 'react';

/** What opens below a button and is more than a menu: lists with forms. */
export function StudioPopover({
  button,
  label,
  children,
  ...rest
}: { button: ReactNode; label: string; children: ReactNode } & Partial<PopoverProps>) {
  return (
    <Popover
      offset={4}
      transitionProps={{ duration: 0 }}
      classNames={{ dropdown: 'menu' }}
      trapFocus
      returnFocus
      {...rest}
    >
      <Popover.Target>{button as React.ReactElement}</Popover.Target>
      <Popover.Dropdown aria-label={label}>{children}</Popover.Dropdown>
    </Popover>
  );
}
