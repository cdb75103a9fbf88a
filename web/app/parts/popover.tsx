import { Popover, type PopoverProps } from '@mantine/core';
import type { ReactNode } from 'react';
import { kStaysInWindow, useOpened } from './use_opened';

/** What opens below a button and is more than a menu: lists with forms. */
export function StudioPopover({
  button,
  label,
  children,
  opened,
  onChange,
  ...rest
}: { button: ReactNode; label: string; children: ReactNode } & Partial<PopoverProps>) {
  const open = useOpened({ opened, onChange });
  return (
    <Popover
      offset={4}
      middlewares={kStaysInWindow}
      transitionProps={{ duration: 0 }}
      classNames={{ dropdown: 'menu' }}
      trapFocus
      {...rest}
      opened={open.opened}
      onChange={open.onChange}
    >
      <Popover.Target>{button as React.ReactElement}</Popover.Target>
      <Popover.Dropdown aria-label={label}>{children}</Popover.Dropdown>
    </Popover>
  );
}
