import { Menu } from '@mantine/core';
import type { PlanBoard } from '../../../../core/plan/board';
import { kIgnore, kStart, kTerminate, targetsFor } from '../../../../core/plan/model';
import { text } from '../../../text';
import type { Asked } from './use_connecting';

const words = text.draw;

/** "Connect to…": all that a state or event may lead to, by keyboard or after a drop on nothing. */
export function ConnectMenu(props: { board: PlanBoard; asked: Asked; onClose: () => void }) {
  const { board, asked, onClose } = props;
  const { origin } = asked;
  const source = board.source(origin.source);
  const targets =
    source === undefined
      ? []
      : source === kStart
        ? board.model.actors.map((one) => one.name)
        : targetsFor(board.model, source);
  const now = board.drawing.arrows.find((one) => one.id === origin.id)?.target ?? null;
  const choose = (target: string | null) => {
    board.connect(origin.source, origin.outcome, target);
    onClose();
  };
  return (
    <Menu
      opened
      onClose={() => {
        onClose();
        if (asked.beside instanceof HTMLElement) asked.beside.focus();
      }}
      position="bottom-start"
      transitionProps={{ duration: 0 }}
      classNames={{
        dropdown: 'menu',
        item: 'menu__item',
        label: 'menu__label',
        divider: 'menu__line',
      }}
    >
      <Menu.Target>
        <span className="pasked" style={{ left: asked.x, top: asked.y }} />
      </Menu.Target>
      <Menu.Dropdown aria-label={words.connectTo}>
        <Menu.Label>{words.connect(origin.outcome || words.start)}</Menu.Label>
        <div className="pasked__list">
          {targets.map((target) => (
            <Menu.Item key={target} disabled={target === now} onClick={() => choose(target)}>
              {targetName(target)}
            </Menu.Item>
          ))}
        </div>
        {now === null ? null : (
          <>
            <Menu.Divider />
            <Menu.Item onClick={() => choose(null)}>{words.disconnect}</Menu.Item>
          </>
        )}
      </Menu.Dropdown>
    </Menu>
  );
}

export function targetName(target: string): string {
  if (target === kTerminate) return words.terminate;
  return target === kIgnore ? words.ignore : target;
}
