import { IconSearch } from '@tabler/icons-react';
import { useEffect, useMemo, useReducer, useRef, useState } from 'react';
import type { Command } from '../../core/registry';
import { rankCommands, type Ranked } from '../../core/rank';
import { whyNot } from '../commands/why_not';
import { useCommands, useStudio } from '../hooks';
import { kStroke } from '../parts/icons';
import { Kbd } from '../parts/kbd';
import { text } from '../text';
import { OverlayFrame, useCloseOverlay } from '../parts/overlay_frame';

/** All commands, found by what is typed. */
export default function Palette() {
  const studio = useStudio();
  const { registry } = studio;
  const close = useCloseOverlay();
  const commands = useCommands();
  const [query, setQuery] = useState('');
  const [chosen, setChosen] = useState(0);
  const [, redraw] = useReducer((count: number) => count + 1, 0);
  const found = useMemo(
    () =>
      rankCommands(
        commands.filter((one) => !one.hidden),
        query,
        (id) => registry.isEnabled(id),
      ),
    [commands, query, registry],
  );
  const run = (index: number) => {
    const command = found[index]?.command;
    if (!command) return;
    // What could be done when the list was drawn: now it says why not.
    if (!registry.isEnabled(command.id)) return redraw();
    close();
    registry.run(command.id);
  };
  const onKey = (key: string) => {
    const by = { ArrowDown: 1, ArrowUp: -1, PageDown: 8, PageUp: -8 }[key];
    if (by) setChosen(Math.max(0, Math.min(found.length - 1, chosen + by)));
    else if (key === 'Enter') run(chosen);
    return by !== undefined || key === 'Enter';
  };
  return (
    <OverlayFrame label={text.commands['palette.open']}>
      <div className="palette">
        <div className="palette__search">
          <IconSearch size={16} stroke={kStroke} aria-hidden />
          <input
            autoFocus
            role="combobox"
            aria-label={text.overlay.search}
            aria-expanded="true"
            aria-controls="palette-list"
            aria-activedescendant={found[chosen] ? `palette-${chosen}` : undefined}
            placeholder={text.overlay.search}
            value={query}
            spellCheck={false}
            onChange={(event) => (setQuery(event.target.value), setChosen(0))}
            onKeyDown={(event) => onKey(event.key) && event.preventDefault()}
          />
          <Kbd keys="Esc" />
        </div>
        <ul
          className="palette__list"
          id="palette-list"
          role="listbox"
          aria-label={text.commands['palette.open']}
        >
          {found.map((one, index) => (
            <Item
              key={one.command.id}
              ranked={one}
              index={index}
              chosen={index === chosen}
              why={whyNot(studio, one.command)}
              onRun={() => run(index)}
            />
          ))}
        </ul>
        {found.length === 0 ? <p className="quiet">{text.overlay.none}</p> : null}
      </div>
    </OverlayFrame>
  );
}

interface ItemProps {
  ranked: Ranked;
  index: number;
  chosen: boolean;
  /** Why it cannot be done now; '': it can. */
  why: string;
  onRun(): void;
}

function Item({ ranked, index, chosen, why, onRun }: ItemProps) {
  const row = useRef<HTMLLIElement>(null);
  useEffect(() => {
    if (chosen) row.current?.scrollIntoView({ block: 'nearest' });
  }, [chosen]);
  const { command, marked } = ranked;
  return (
    <li
      ref={row}
      id={`palette-${index}`}
      role="option"
      className="palette__item"
      aria-selected={chosen}
      aria-disabled={why !== ''}
      onClick={onRun}
    >
      <span>
        {[...command.title].map((letter, at) =>
          marked.has(at) ? <mark key={at}>{letter}</mark> : letter,
        )}
      </span>
      {why ? <span className="palette__why">{why}</span> : null}
      <span className="palette__group">{command.group}</span>
      <Keys command={command} />
    </li>
  );
}

function Keys({ command }: { command: Command }) {
  return command.keys?.[0] ? <Kbd keys={command.keys[0]} /> : null;
}
