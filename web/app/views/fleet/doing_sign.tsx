import type { Doing } from '../../../core/fleet';

/** Each has a shape of its own beside its colour. */
const shapes: Record<Doing, string> = {
  fault: 'M4 1h4l3 3v4l-3 3h-4l-3 -3v-4zM4.5 4.5l3 3M7.5 4.5l-3 3',
  stuck: 'M6 1.5l5 9h-10zM6 5v2.5M6 9v.1',
  lost: 'M2.5 2.5l7 7M9.5 2.5l-7 7',
  waiting: 'M6 1a5 5 0 1 0 .01 0zM6 3.5v2.5l1.8 1.2',
  running: 'M3 2l7 4l-7 4z',
  paused: 'M4 2.5v7M8 2.5v7',
  stopped: 'M2.5 2.5h7v7h-7z',
  offline: 'M2 6h8',
};

export function DoingSign({ doing }: { doing: Doing }) {
  return (
    <svg className={`fsign fsign--${doing}`} viewBox="0 0 12 12" aria-hidden>
      <path d={shapes[doing]} />
    </svg>
  );
}
