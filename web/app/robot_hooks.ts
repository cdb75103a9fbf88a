// How components look at the robot's variables, events and plots.

import { useEffect, useState, useSyncExternalStore, type RefObject } from 'react';
import type { Node, NodeId, Variable } from '../protocol/messages';
import type { PickList } from '../core/picks';
import { isReady } from '../core/run_choice';
import { useChanges, usePart, useStudio } from './hooks';
import { text } from './text';

/** True while a part of the page can be seen: its tab is in front and it is scrolled into view. */
export function useShown(place: RefObject<HTMLElement | null>): boolean {
  const [shown, setShown] = useState(false);
  useEffect(() => {
    if (!place.current) return;
    const observer = new IntersectionObserver((entries) =>
      setShown(entries.at(-1)?.isIntersecting ?? false),
    );
    observer.observe(place.current);
    return () => observer.disconnect();
  }, [place]);
  return shown;
}

/** What a node does, in a word. */
export function useNodeWord(): (state: Node['state']) => string {
  const kind = usePart('robot', {}, (is) => is?.kind);
  const waits = usePart('clock', {}, (is) => kind !== undefined && isReady({ kind }, is));
  return (state) =>
    waits && state === 'running' ? text.target.ready : text.target.nodeState[state];
}

export function usePicks(list: PickList) {
  useChanges(list.changed);
  return list.list;
}

/** The variables of some nodes; undefined for those whose description has not come. */
export function useVariablesOf(nodes: readonly NodeId[]): ReadonlyMap<NodeId, readonly Variable[]> {
  const { topics } = useStudio();
  const key = nodes.join(' ');
  const [known, setKnown] = useState<ReadonlyMap<NodeId, readonly Variable[]>>(new Map());
  useEffect(() => {
    const ids = key === '' ? [] : key.split(' ').map(Number);
    const look = () =>
      setKnown(
        new Map(
          ids.flatMap((node) => {
            const variables = topics.get('node', { node })?.variables;
            return variables ? [[node, variables]] : [];
          }),
        ),
      );
    const ends = ids.map((node) => topics.subscribe('node', { node }, look));
    look();
    return () => ends.forEach((end) => end());
  }, [topics, key]);
  return known;
}

/** The theme that is shown, for what draws its colours itself. */
export function useShownTheme(): string {
  return useSyncExternalStore(
    followTheme,
    () => document.documentElement.dataset['theme'] ?? 'dark',
  );
}

function followTheme(listener: () => void): () => void {
  const observer = new MutationObserver(listener);
  observer.observe(document.documentElement, { attributeFilter: ['data-theme'] });
  return () => observer.disconnect();
}
