import { IconChevronDown, IconChevronRight } from '@tabler/icons-react';
import { useState, type ReactNode } from 'react';
import { kStroke } from '../../parts/icons';

/** A heading that folds and unfolds what stands under it. */
export function Group({
  title,
  note,
  open,
  wanted = false,
  tools,
  children,
}: {
  title: string;
  note: string;
  open: boolean;
  /** Something in it was asked for: it unfolds. */
  wanted?: boolean;
  tools?: ReactNode;
  children: ReactNode;
}) {
  const [shown, setShown] = useState(open);
  const [wasWanted, setWasWanted] = useState(false);
  if (wanted !== wasWanted) {
    setWasWanted(wanted);
    if (wanted) setShown(true);
  }
  const Icon = shown ? IconChevronDown : IconChevronRight;
  return (
    <section>
      <div className="group">
        <button
          type="button"
          className="group__toggle"
          aria-expanded={shown}
          onClick={() => setShown(!shown)}
        >
          <Icon className="icon" size={14} stroke={kStroke} aria-hidden />
          <span className="ellipsis">{title}</span>
          <span className="group__note num">{note}</span>
        </button>
        {tools}
      </div>
      {shown ? children : null}
    </section>
  );
}
