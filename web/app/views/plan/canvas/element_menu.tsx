import { Menu } from '@mantine/core';
import { CommandItem, StudioMenu } from '../../../parts/menu';
import { text } from '../../../text';
import { drawWords } from '../words';
import type { MenuAt } from './use_element_menu';
import { planWords } from '../live_words';

const debugging = ['draw.break', 'draw.breakEdit', 'draw.log', 'draw.into', 'draw.script'];
const editing = [
  'draw.open',
  'draw.properties',
  'draw.rename',
  'draw.duplicate',
  'draw.extract',
  'draw.remove',
];

const anywhere = ['draw.add', 'draw.note', 'draw.variable', 'draw.paste'];
const whole = ['draw.all', 'draw.tidy', 'draw.fit'];

/** What can be done with the element under the pointer, or the one that has the keyboard; or with the plan. */
export function ElementMenu({ at, onClose }: { at: MenuAt; onClose: () => void }) {
  return (
    <StudioMenu
      opened
      onChange={(open) => {
        if (open) return;
        onClose();
        at.beside?.focus();
      }}
      button={<span className="pasked" style={{ left: at.x, top: at.y }} />}
    >
      {at.of === 'element' ? <OfElement /> : <OfCanvas />}
    </StudioMenu>
  );
}

const OfElement = () => (
  <>
    <CommandItem id="draw.why" title={text.why.menu} />
    <CommandItem id="draw.runFrom" title={planWords.from.menu} />
    <Menu.Label>{drawWords.debugging}</Menu.Label>
    <Commands ids={debugging} />
    <Menu.Divider />
    <Commands ids={editing} />
  </>
);

const OfCanvas = () => (
  <>
    <Commands ids={anywhere} />
    <Menu.Divider />
    <Commands ids={whole} />
  </>
);

const Commands = ({ ids }: { ids: readonly string[] }) =>
  ids.map((id) => <CommandItem key={id} id={id} />);
