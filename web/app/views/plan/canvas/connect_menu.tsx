import { Menu } from '@mantine/core';
import { useState } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import { kIgnore, kStart, kTerminate, targetsFor } from '../../../../core/plan/model';
import type { Point } from '../../../../core/plan/shape';
import { usable, type Found } from '../../../../core/plan/templates';
import { useTopic } from '../../../hooks';
import { StudioMenu } from '../../../parts/menu';
import { drawWords as words } from '../words';
import { TemplateIcon } from './template_icon';
import type { Asked } from './use_connecting';
import '../../../look/draw.css';

/** "Connect to…": all that a state or event may lead to, by keyboard or after a drop on nothing. */
export function ConnectMenu(props: {
  board: PlanBoard;
  asked: Asked;
  onClose: () => void;
  onMade: (key: string) => void;
}) {
  const { board, asked, onClose, onMade } = props;
  const { origin } = asked;
  const [typed, type] = useState('');
  const targets = targetsOf(board, origin.source).filter((one) => has(targetName(one), typed));
  const news = useTemplates(board, typed);
  const now = board.drawing.arrows.find((one) => one.id === origin.id)?.target ?? null;
  const choose = (target: string | null) => {
    board.connect(origin.source, origin.outcome, target);
    onClose();
  };
  const make = (found: Found) => {
    onMade(board.addTarget(found, asked.at ?? besides(board, origin.source), origin));
    onClose();
  };
  const first = () => {
    const [target] = targets;
    const [found] = news;
    if (target !== undefined) choose(target);
    else if (found) make(found);
  };
  return (
    <StudioMenu
      opened
      hasField
      onClose={() => {
        onClose();
        if (asked.beside instanceof HTMLElement) asked.beside.focus();
      }}
      button={<span className="pasked" style={{ left: asked.x, top: asked.y }} />}
    >
      <Menu.Label>{words.connect(origin.outcome || words.start)}</Menu.Label>
      <input
        className="field field--small pasked__filter"
        aria-label={words.filterTargets}
        placeholder={words.filterTargets}
        data-autofocus
        autoComplete="off"
        spellCheck={false}
        value={typed}
        onChange={(event) => type(event.target.value)}
        onKeyDown={(event) => {
          if (event.key !== 'Enter' && event.key !== 'ArrowDown') return;
          // The rest of the press would be a click on what has the keyboard next.
          event.preventDefault();
          if (event.key === 'Enter') return first();
          event.currentTarget.parentElement?.querySelector<HTMLElement>('[role=menuitem]')?.focus();
        }}
      />
      <div className="pasked__list">
        {targets.map((target) => (
          <Menu.Item key={target} disabled={target === now} onClick={() => choose(target)}>
            {targetName(target)}
          </Menu.Item>
        ))}
        {news.length === 0 ? null : <Menu.Label>{words.newTarget}</Menu.Label>}
        {news.map((found) => (
          <Menu.Item
            key={`${found.toolbox}.${found.template.name}`}
            title={found.template.help}
            leftSection={<TemplateIcon icon={found.template.icon} />}
            onClick={() => make(found)}
          >
            {words.newOf(found.template.name)}
          </Menu.Item>
        ))}
      </div>
      {now === null ? null : (
        <>
          <Menu.Divider />
          <Menu.Item onClick={() => choose(null)}>{words.disconnect}</Menu.Item>
        </>
      )}
    </StudioMenu>
  );
}

function targetsOf(board: PlanBoard, key: string): string[] {
  const source = board.source(key);
  if (source === undefined) return [];
  return source === kStart
    ? board.model.actors.map((one) => one.name)
    : targetsFor(board.model, source);
}

/** Actors and computations that can be made for what was typed. */
function useTemplates(board: PlanBoard, typed: string): Found[] {
  const toolboxes = useTopic('templates', {})?.toolboxes ?? [];
  return usable(toolboxes, board.model.toolboxes, typed).filter(
    ({ template }) => template.kind !== 'supervisor',
  );
}

const has = (name: string, typed: string) =>
  name.toLowerCase().includes(typed.trim().toLowerCase());

/** Right of where the arrow begins. */
function besides(board: PlanBoard, source: string): Point {
  const box = board.boxOf(source) ?? { x: 0, y: 0, width: 0 };
  return { x: box.x + box.width + kAside, y: box.y };
}

const kAside = 72;

/** As it is called on screen. */
export function targetName(target: string): string {
  return target === kTerminate ? words.terminate : target === kIgnore ? words.ignore : target;
}
