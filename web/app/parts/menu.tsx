import { Menu, type MenuItemProps, type MenuProps } from '@mantine/core';
import { useEffect, useRef, type ReactNode } from 'react';
import { useStudio } from '../hooks';
import { Kbd } from './kbd';
import { kStaysInWindow, useOpened } from './use_opened';

/** A menu in the look of the studio. hasField: a field in it has the focus first, to narrow the items. */
export function StudioMenu({
  button,
  children,
  opened,
  onChange,
  hasField = false,
  ...rest
}: { button: ReactNode; children: ReactNode; hasField?: boolean } & Partial<MenuProps>) {
  const open = useOpened({ opened, onChange });
  return (
    <Menu
      position="bottom-start"
      offset={4}
      middlewares={kStaysInWindow}
      transitionProps={{ duration: 0 }}
      classNames={{
        dropdown: 'menu',
        item: 'menu__item',
        label: 'menu__label',
        divider: 'menu__line',
      }}
      returnFocus={false}
      withInitialFocusPlaceholder={false}
      {...rest}
      opened={open.opened}
      onChange={open.onChange}
    >
      <Menu.Target>{button as React.ReactElement}</Menu.Target>
      <Menu.Dropdown onKeyDown={open.onKeyDown}>
        <Items hasField={hasField}>{children}</Items>
      </Menu.Dropdown>
    </Menu>
  );
}

/**
 * Has the focus until a key chooses an item. The library has an element of its own for that, between the items,
 * with no role that a menu may contain. The library gives it the focus a moment later: a key that is pressed at
 * once would be for what had it before. Not while things are laid out: then useOpened() notes what had it.
 */
function Items({ children, hasField }: { children: ReactNode; hasField: boolean }) {
  const group = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!hasField) group.current?.focus({ preventScroll: true });
  }, [hasField]);
  return (
    <div
      ref={group}
      role="group"
      tabIndex={-1}
      data-autofocus={hasField ? undefined : true}
      data-mantine-stop-propagation="true"
      className="menu__items"
    >
      {children}
    </div>
  );
}

/** An entry for a command of the registry, with its keys. */
export function CommandItem({ id, title, icon }: { id: string; title?: string; icon?: ReactNode }) {
  const { registry } = useStudio();
  const command = registry.find(id);
  if (!command) return null;
  const keys = command.keys?.[0];
  return (
    <WhyItem
      why={registry.whyNot(command)}
      leftSection={icon}
      rightSection={keys ? <Kbd keys={keys} /> : null}
      onClick={() => registry.run(id)}
    >
      {title ?? command.title}
    </WhyItem>
  );
}

/** An entry that says why it cannot be chosen now; why: '' it can. */
export function WhyItem({
  why,
  children,
  ...rest
}: { why: string; children: ReactNode; onClick(): void } & MenuItemProps) {
  return (
    <Menu.Item {...rest} disabled={why !== ''}>
      {children}
      {why ? <span className="menu__help">{why}</span> : null}
    </Menu.Item>
  );
}
