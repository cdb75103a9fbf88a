import { IconSearch } from '@tabler/icons-react';
import { useEffect, useMemo, useRef, useState } from 'react';
import { findHelp, type HelpEntry } from '../../../core/help/entries';
import { kStroke } from '../../parts/icons';
import { HelpText } from './help_text';
import { useHelpEntries } from './use_help_entries';
import { helpWords } from './words';

const words = helpWords;

/** One field for all there is help for; beside the list what is chosen in it. */
export function HelpSearch({ first, takesFocus }: { first: string; takesFocus: boolean }) {
  const { entries, hasRobot } = useHelpEntries();
  const [query, setQuery] = useState(first);
  const [chosen, setChosen] = useState(0);
  const found = useMemo(() => findHelp(entries, query), [entries, query]);
  const entry = found[chosen];
  const onKey = (key: string) => {
    const by = { ArrowDown: 1, ArrowUp: -1, PageDown: 8, PageUp: -8 }[key];
    if (by) setChosen(Math.max(0, Math.min(found.length - 1, chosen + by)));
    return by !== undefined;
  };
  return (
    <>
      <label className="search">
        <IconSearch size={14} stroke={kStroke} aria-hidden />
        <input
          autoFocus={takesFocus}
          role="combobox"
          aria-label={words.search}
          aria-expanded="true"
          aria-controls="help-list"
          aria-activedescendant={entry ? `help-${chosen}` : undefined}
          placeholder={words.search}
          value={query}
          spellCheck={false}
          onFocus={(event) => event.target.select()}
          onChange={(event) => (setQuery(event.target.value), setChosen(0))}
          onKeyDown={(event) => onKey(event.key) && event.preventDefault()}
        />
      </label>
      <div className="help__parts">
        <ul className="help__list" id="help-list" role="listbox" aria-label={words.found}>
          {found.map((one, index) => (
            <Item
              key={`${one.kind} ${one.node} ${one.name}`}
              entry={one}
              id={`help-${index}`}
              chosen={index === chosen}
              onChoose={() => setChosen(index)}
            />
          ))}
        </ul>
        {entry ? <HelpText entry={entry} /> : <p className="quiet">{words.none}</p>}
      </div>
      {hasRobot ? null : <p className="quiet">{words.noRobot}</p>}
    </>
  );
}

interface ItemProps {
  entry: HelpEntry;
  id: string;
  chosen: boolean;
  onChoose(): void;
}

function Item({ entry: { name, kind, node }, id, chosen, onChoose }: ItemProps) {
  const row = useRef<HTMLLIElement>(null);
  useEffect(() => {
    if (chosen) row.current?.scrollIntoView({ block: 'nearest' });
  }, [chosen]);
  return (
    <li
      ref={row}
      id={id}
      role="option"
      className="help__item"
      aria-selected={chosen}
      onClick={onChoose}
    >
      <span className={kind === 'topic' ? 'ellipsis' : 'ellipsis help__name'}>{name}</span>
      <span className="help__kind">{node || words.kinds[kind]}</span>
    </li>
  );
}
