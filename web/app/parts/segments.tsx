import { useLayoutEffect, useRef } from 'react';
import { tipOf } from './button';

interface Segment<T> {
  value: T;
  words: string;
  tip?: string;
}

/** One of a few, side by side: arrows choose, as in any group of radio buttons. */
export function Segments<T>(props: {
  label: string;
  segments: readonly Segment<T>[];
  chosen: T;
  onChoose(value: T): void;
  small?: boolean;
  numbers?: boolean;
  disabled?: boolean;
  /** The chosen one has the keyboard once it is there. */
  takesFocus?: boolean;
}) {
  const { label, segments, chosen, onChoose, small, numbers, disabled = false } = props;
  const group = useRef<HTMLDivElement>(null);
  const at = segments.findIndex(({ value }) => value === chosen);
  const { takesFocus = false } = props;
  useLayoutEffect(() => {
    if (takesFocus) group.current?.querySelector<HTMLElement>('[aria-checked=true]')?.focus();
  }, [takesFocus]);
  const move = (by: number) => {
    const next = (at + by + segments.length) % segments.length;
    const segment = segments[next];
    if (!segment) return;
    onChoose(segment.value);
    group.current?.querySelectorAll('button')[next]?.focus();
  };
  return (
    <div
      className={small ? 'seg seg--small' : 'seg'}
      role="radiogroup"
      aria-label={label}
      ref={group}
      onKeyDown={(event) => {
        const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
        if (by) (event.preventDefault(), move(by));
      }}
    >
      {segments.map(({ value, words, tip }, index) => (
        <button
          key={words}
          type="button"
          role="radio"
          className={numbers ? 'seg__part num' : 'seg__part'}
          aria-checked={index === at}
          // Nothing is chosen: the first can be reached.
          tabIndex={index === Math.max(0, at) ? 0 : -1}
          disabled={disabled}
          {...tipOf(tip)}
          onClick={() => onChoose(value)}
        >
          {words}
        </button>
      ))}
    </div>
  );
}
