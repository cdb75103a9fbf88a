import { Menu, type MenuProps } from '@mantine/core';
import type { ReactNode } from 'react';
import { useStudio } from '../hooks';
import { Kbd } from './kbd';

/** A menu in the look of the studio. */
export function StudioMenu({
  button,
  children,
  ...rest
}: { button: ReactNode; children: ReactNode } & Partial<MenuProps>) {
  return (
    <Menu
      position="bottom-start"
      offset={4}
      transitionProps={{ duration: 0 }}
      classNames={{
        dropdown: 'menu',
        item: 'menu__item',
        label: 'menu__label',
        divider: 'menu__line',
      }}
      {...rest}
    >
      <Menu.Target>{button as React.ReactElement}</Menu.Target>
      <Menu.Dropdown>{children}</Menu.Dropdown>
    </Menu>
  );
}

/** An entry for a command of the registry, with its keys. */
export function CommandItem({ id, title, icon }: { id: string; title?: string; icon?: ReactNode }) {
  const { registry } = useStudio();
  const command = registry.find(id);
  if (!command) return null;
  const keys = command.keys?.[0];
  return (
    <Menu.Item
      leftSection={icon}
      rightSection={keys ? <Kbd keys={keys} /> : null}
      disabled={!registry.isEnabled(id)}
      onClick={() => registry.run(id)}
    >
      {title ?? command.title}
    </Menu.Item>
  );
}
