import { useEffect, useRef, type KeyboardEvent, type MouseEvent } from 'react';
import { clicked, keyed, toggled, type Hold } from '../../../core/fleet';
import { toast } from '../../../core/window_state';
import { usePart, useStudio } from '../../hooks';
import { Blank, Quiet } from '../../parts/blank';
import { FleetTile } from './fleet_tile';
import { useFleetDesk, useIsConnected, useList } from './use_fleet';
import { words } from './words';

const holdOf = (event: MouseEvent | KeyboardEvent): Hold => ({
  shift: event.shiftKey,
  ctrl: event.ctrlKey || event.metaKey,
});

/** A tile for each robot; many can be chosen, as in a list of files. */
export function FleetGrid() {
  const studio = useStudio();
  const desk = useFleetDesk();
  const list = useList();
  const isConnected = useIsConnected();
  const isEmpty = usePart('fleet', {}, (is) => Object.keys(is?.robots ?? {}).length === 0);
  const target = usePart('fleet', {}, (is) => is?.target ?? '');
  const grid = useRef<HTMLDivElement>(null);
  const moved = useRef(false);
  const { choice } = desk;
  const at = choice.at !== null && list.includes(choice.at) ? choice.at : (list[0] ?? null);

  useEffect(() => {
    if (!moved.current) return;
    moved.current = false;
    tileOf(grid.current, at)?.focus();
  }, [at]);

  const open = (name: string) => {
    const robot = studio.topics.get('fleet', {})?.robots[name];
    if (robot?.studio && robot.connection === 'online')
      return void window.open(robot.studio, '_blank', 'noopener,noreferrer');
    const why = robot?.connection === 'online' ? words.noStudio(name) : words.offlineStudio(name);
    toast(studio.window, 'note', why);
  };
  const pressed = (event: KeyboardEvent) => {
    if (event.altKey) return;
    if (event.key === 'Enter' && at !== null) {
      event.preventDefault();
      return open(at);
    }
    const next = keyed({ ...choice, at }, list, event.key, columnsOf(grid.current), holdOf(event));
    if (!next) return;
    event.preventDefault();
    moved.current = next.at !== at;
    desk.set({ choice: next });
  };
  const pointed = (event: MouseEvent<HTMLElement>) => {
    const { name, act } = partOf(event);
    if (name === undefined) return;
    if (act === 'open') return open(name);
    const hold = holdOf(event);
    desk.set({
      choice:
        act === 'toggle' && !hold.shift ? toggled(choice, name) : clicked(choice, list, name, hold),
    });
  };
  const opened = (event: MouseEvent<HTMLElement>) => {
    const { name, act } = partOf(event);
    if (name !== undefined && act === undefined) open(name);
  };

  if (isEmpty)
    return (
      <Blank title={words.none}>
        <p>
          <code>
            {words.noneHelp} {target}
          </code>
        </p>
      </Blank>
    );
  if (list.length === 0) return <Quiet>{words.noMatch}</Quiet>;
  return (
    <div
      ref={grid}
      role="listbox"
      aria-multiselectable
      aria-label={words.tiles}
      aria-description={words.tilesHelp}
      className="fgrid"
      data-place="fleet"
      onKeyDown={pressed}
      onClick={pointed}
      onDoubleClick={opened}
    >
      {list.map((name) => (
        <FleetTile
          key={name}
          name={name}
          isChosen={choice.chosen.has(name)}
          isAt={name === at}
          isConnected={isConnected}
        />
      ))}
    </div>
  );
}

/** Whose tile was pressed, and what in it. */
function partOf({ target }: MouseEvent): { name?: string; act?: string } {
  const of = (what: 'robot' | 'act') =>
    target instanceof Element
      ? target.closest<HTMLElement>(`[data-${what}]`)?.dataset[what]
      : undefined;
  return { name: of('robot'), act: of('act') };
}

function tileOf(grid: HTMLElement | null, name: string | null): HTMLElement | null {
  return name === null
    ? null
    : (grid?.querySelector<HTMLElement>(`[data-robot="${CSS.escape(name)}"]`) ?? null);
}

/** Tiles in a row, as they stand now. */
function columnsOf(grid: HTMLElement | null): number {
  const columns = grid ? getComputedStyle(grid).gridTemplateColumns.split(' ').length : 1;
  return Math.max(1, columns);
}
