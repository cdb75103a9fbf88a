import { IconFilter } from '@tabler/icons-react';
import type { KeyboardEvent } from 'react';
import { kStroke } from './icons';

/** Narrows the list below it. Escape empties it; Ctrl+F of the panel finds it by its name. */
export function FilterField(props: {
  name: string;
  label: string;
  value: string;
  onChange(value: string): void;
  onKey?(event: KeyboardEvent<HTMLElement>): void;
}) {
  const { name, label, value, onChange, onKey } = props;
  return (
    <label className="search search--small">
      <IconFilter size={13} stroke={kStroke} aria-hidden />
      <input
        type="search"
        data-find={name}
        aria-label={label}
        placeholder={label}
        value={value}
        spellCheck={false}
        onChange={(event) => onChange(event.target.value)}
        onKeyDown={(event) => (event.key === 'Escape' ? onChange('') : onKey?.(event))}
      />
    </label>
  );
}
