import { useSyncExternalStore } from 'react';
import { shownSpan } from '../../../core/fleet';
import { useStudio } from '../../hooks';

const listeners = new Set<() => void>();
let timer: ReturnType<typeof setInterval> | undefined;

/** One timer for all that count; it ends with the last of them. */
function everySecond(listener: () => void): () => void {
  listeners.add(listener);
  timer ??= setInterval(() => listeners.forEach((one) => one()), 1000);
  return () => {
    listeners.delete(listener);
    if (listeners.size > 0) return;
    clearInterval(timer);
    timer = undefined;
  };
}

/** How long ago something was; drawn again only when it reads differently. */
export function Since({ wall, words }: { wall: number; words: (span: string) => string }) {
  const { connection } = useStudio();
  const span = useSyncExternalStore(everySecond, () => shownSpan(connection.wall() - wall));
  return <>{words(span)}</>;
}
