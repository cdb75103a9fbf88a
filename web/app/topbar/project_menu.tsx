import { Menu } from '@mantine/core';
import { IconChevronDown } from '@tabler/icons-react';
import { useCommands } from '../hooks';
import { kStroke } from '../parts/icons';
import { CommandItem, StudioMenu } from '../parts/menu';
import { text } from '../text';

export function ProjectMenu({ name }: { name: string }) {
  useCommands();
  const button = (
    <button type="button" className="crumb__button" aria-label={`${text.menu.project}: ${name}`}>
      <span className="ellipsis">{name}</span>
      <IconChevronDown className="icon" size={14} stroke={kStroke} aria-hidden />
    </button>
  );
  return (
    <div className="crumb">
      <StudioMenu button={button}>
        <CommandItem id="file.save" />
        <CommandItem id="file.saveAll" />
        <CommandItem id="file.export" />
        <Menu.Divider />
        <Menu.Label>{text.groups.file}</Menu.Label>
        <CommandItem id="file.new.script" />
        <CommandItem id="file.new.plan" />
        <CommandItem id="file.new.world" />
        <Menu.Divider />
        <CommandItem id="folder.open" />
        <CommandItem id="project.new" />
        <CommandItem id="project.start" />
        <Menu.Divider />
        <CommandItem id="layout.reset" />
        <CommandItem id="settings.open" />
      </StudioMenu>
    </div>
  );
}
