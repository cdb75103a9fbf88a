// How components look at the studio: a context and three stores.

import { createContext, useCallback, useContext, useSyncExternalStore } from 'react';
import { useStore } from 'zustand';
import type { Doc, Topics } from '../protocol/messages';
import type { Link } from '../core/connection';
import type { Emitter } from '../core/emitter';
import { readSettings, type Settings } from '../core/settings';
import type { Studio } from '../core/studio';
import type { DocumentTopic } from '../core/topics';
import { showsFleet, type WindowState } from '../core/window_state';
import type { Command } from '../core/registry';

export const StudioContext = createContext<Studio | null>(null);

export function useStudio(): Studio {
  const studio = useContext(StudioContext);
  if (!studio) throw new Error('a component is outside of the studio');
  return studio;
}

/** A document of the server; undefined until it has come. of: null looks at nothing. */
export function useTopic<T extends DocumentTopic>(
  topic: T,
  of: Topics[T]['of'] | null,
): Topics[T]['is'] | undefined {
  return usePart(topic, of, whole);
}

function whole<V>(value: V): V {
  return value;
}

/**
 * A part of a document: drawn again only when that part is another one. What is selected is a
 * plain value, or a piece of the document as it came.
 */
export function usePart<T extends DocumentTopic, P>(
  topic: T,
  of: Topics[T]['of'] | null,
  select: (value: Topics[T]['is'] | undefined) => P,
): P {
  const { topics } = useStudio();
  const key = of && JSON.stringify(of);
  const subscribe = useCallback(
    (listener: () => void) =>
      key === null ? () => {} : topics.subscribe(topic, asOf<T>(key), listener),
    [topics, topic, key],
  );
  return useSyncExternalStore(subscribe, () =>
    select(key === null ? undefined : topics.get(topic, asOf<T>(key))),
  );
}

// The key is the text of an "of" that was typed where it came in.
function asOf<T extends DocumentTopic>(key: string): Topics[T]['of'] {
  return JSON.parse(key) as Topics[T]['of'];
}

/** Renders again when something has changed; the number says how often it has. */
export function useChanges(changed: Emitter<void>): number {
  return useSyncExternalStore(
    useCallback((listener: () => void) => changed.on(listener), [changed]),
    () => changed.count,
  );
}

/** Something was typed that the server does not have; with a document: in that one. */
export function useUnsent(doc?: Doc): boolean {
  return useDocuments((documents) =>
    doc === undefined ? documents.isUnsent : documents.waits(doc),
  );
}

/** A file that is looked at is not on disk. */
export function useIsGone(): boolean {
  return useDocuments((documents) => documents.isGone);
}

/** What `select` gives of the open files; a plain value. */
export function useDocuments<P>(select: (documents: Studio['documents']) => P): P {
  const { documents } = useStudio();
  return useSyncExternalStore(
    useCallback((listener: () => void) => documents.changed.on(listener), [documents]),
    () => select(documents),
  );
}

export function useWindow<T>(select: (state: WindowState) => T): T {
  return useStore(useStudio().window, select);
}

export function useLink(): Link {
  const { connection } = useStudio();
  return useSyncExternalStore(
    useCallback((listener: () => void) => connection.changed.on(listener), [connection]),
    () => connection.link,
  );
}

export function useCommands(): readonly Command[] {
  const { registry } = useStudio();
  return useSyncExternalStore(
    useCallback((listener: () => void) => registry.changed.on(listener), [registry]),
    () => registry.list(),
  );
}

/** The name of the fleet that is open; null: none. A robot that serves itself looks at none. */
export function useFleetName(): string | null {
  const mayLook = usePart('studio', {}, (is) => is !== undefined && is.serves !== true);
  return usePart('fleet', mayLook ? {} : null, (is) =>
    is && is.state !== 'none' ? (is.fleet ?? '') : null,
  );
}

/** The window shows the fleet. */
export function useFleetShown(): boolean {
  const isOpen = useFleetName() !== null;
  const hasProject = usePart('studio', {}, (is) => is?.project !== undefined);
  const isChosen = useWindow((state) => showsFleet(state, hasProject));
  return isOpen && isChosen;
}

export function useSettings(): Settings {
  return readSettings(useTopic('studio', {})?.settings);
}

/** True if this page may change files: also while there is no connection. */
export function useMayEdit(): boolean {
  const studio = useStudio();
  useLink();
  useTopic('studio', {});
  return studio.mayEdit;
}

/** True if this page may change things. */
export function useDrives(): boolean {
  const link = useLink();
  const studio = useTopic('studio', {});
  return link.state === 'open' && studio?.driver === link.number;
}
