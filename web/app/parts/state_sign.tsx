import type { Node } from '../../protocol/messages';

const shapes: Record<Node['state'], string> = {
  running: 'M3 2l7 4l-7 4z',
  paused: 'M6 1a5 5 0 1 0 .01 0zM4.2 3.6v4.8M7.8 3.6v4.8',
  stopped: 'M2.5 2.5h7v7h-7z',
  unknown: 'M6 1.5a4.5 4.5 0 1 0 .01 0z',
  gone: 'M2.5 2.5l7 7M9.5 2.5l-7 7',
};

/** The state of a node by shape and colour; its word is beside it or in a label. */
export function StateSign({ state }: { state: Node['state'] }) {
  return (
    <svg className={`sign sign--${state}`} viewBox="0 0 12 12" aria-hidden>
      <path d={shapes[state]} />
    </svg>
  );
}

/** The same inside another picture, around a point. */
export function StateMark({ state, x, y }: { state: Node['state']; x: number; y: number }) {
  return (
    <path
      className={`sign sign--${state}`}
      d={shapes[state]}
      transform={`translate(${x - 6} ${y - 6})`}
    />
  );
}
