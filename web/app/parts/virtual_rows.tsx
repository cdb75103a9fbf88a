import { useCallback, useRef, useState, type KeyboardEvent, type ReactNode } from 'react';
import { isField, nextRow, rowOf, showRow, stepInside, useAnchor, useSeen } from './virtual_keys';

/** Rows above and below those that are seen, so that fast scrolling shows no holes. */
const kMore = 6;

export interface VirtualRowsProps<Row> {
  rows: readonly Row[];
  label: string;
  keyOf(row: Row): string | number;
  children(row: Row): ReactNode;
  className?: string;
  height?: number;
  /** The newest row is first: what is read stays where it is while others come above it. */
  newestFirst?: boolean;
  onRowKey?(row: Row, event: KeyboardEvent<HTMLElement>): void;
}

/**
 * A list of which only what is seen is in the page. Up and down go from row to row, right and left
 * through the buttons of a row.
 */
export function VirtualRows<Row>({
  rows,
  label,
  keyOf,
  children,
  className = '',
  height = 24,
  newestFirst,
  onRowKey,
}: VirtualRowsProps<Row>) {
  const frame = useRef<HTMLDivElement>(null);
  const { first, count } = useSeen(frame, height);
  const [active, setActive] = useState(0);
  const from = Math.max(0, Math.min(first - kMore, rows.length));
  const end = Math.min(rows.length, first + count + kMore);
  useAnchor(frame, newestFirst ? rows : null, keyOf, height);
  const current = Math.min(active, rows.length - 1);
  const go = useCallback(
    (index: number) => {
      setActive(index);
      showRow(frame.current, index, height);
      const focus = () => {
        const row = frame.current?.querySelector<HTMLElement>(`[data-row="${index}"]`);
        row?.focus();
        return row !== undefined && row !== null;
      };
      // At once, so that the next key is pressed there; a row out of sight has to be drawn first.
      if (!focus()) requestAnimationFrame(focus);
    },
    [height],
  );
  const pressed = (event: KeyboardEvent<HTMLElement>) => {
    const row = rowOf(event.target);
    const index = Number(row?.dataset['row'] ?? -1);
    const about = rows[index];
    if (!row || about === undefined || isField(event.target)) return;
    if (event.target === row) onRowKey?.(about, event);
    if (event.defaultPrevented || event.ctrlKey || event.altKey || event.metaKey) return;
    const target = nextRow(event.key, index, rows.length, count);
    if (target !== null) go(target);
    else if (!stepInside(row, event)) return;
    event.preventDefault();
  };
  return (
    <div className={`scroll virtual ${className}`} ref={frame} onKeyDown={pressed}>
      <div
        role="list"
        aria-label={label}
        style={{ paddingTop: from * height, paddingBottom: (rows.length - end) * height }}
      >
        {rows.slice(from, end).map((row, index) => (
          <div
            key={keyOf(row)}
            role="listitem"
            aria-setsize={rows.length}
            aria-posinset={from + index + 1}
            data-row={from + index}
            data-inset
            className="virtual__row"
            style={{ height }}
            tabIndex={from + index === current ? 0 : -1}
            onFocus={() => setActive(from + index)}
          >
            {children(row)}
          </div>
        ))}
      </div>
    </div>
  );
}
