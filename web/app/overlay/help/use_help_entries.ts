// What there is help for: the pages of docs/ as they are, and what the nodes of the target tell.

import { useMemo, useSyncExternalStore } from 'react';
import languagePage from '../../../../docs/aesl.md?raw';
import robotPage from '../../../../docs/thymio.md?raw';
import { languageEntries, robotEntries, type HelpEntry } from '../../../core/help/entries';
import { examplesIn, sectionsOf } from '../../../core/help/page';
import type { TopicCache } from '../../../core/topics';
import { usePart, useStudio } from '../../hooks';

const language = sectionsOf(languagePage);
const examples = examplesIn([...language, ...sectionsOf(robotPage)]);

export function useHelpEntries(): { entries: readonly HelpEntry[]; hasRobot: boolean } {
  const nodes = useNodes();
  return useMemo(() => {
    const own = robotEntries(nodes, examples);
    return { entries: [...languageEntries(language), ...own], hasRobot: own.length > 0 };
  }, [nodes]);
}

/** The descriptions of all nodes of the target; one of each name is asked for. */
function useNodes() {
  const { topics } = useStudio();
  // As text: drawn again only when there are others.
  const ids = usePart('robot', {}, (is) => {
    const first = new Map((is?.nodes ?? []).toReversed().map((one) => [one.name, one.id]));
    return JSON.stringify([...first.values()].reverse());
  });
  const store = useMemo(() => storeOf(topics, JSON.parse(ids) as number[]), [topics, ids]);
  return useSyncExternalStore(store.subscribe, store.snapshot);
}

/** Those nodes as one value, which is another only when one of them is. */
function storeOf(topics: TopicCache, wanted: readonly number[]) {
  const read = () => wanted.flatMap((node) => topics.get('node', { node }) ?? []);
  let last = read();
  return {
    subscribe(listener: () => void) {
      const ends = wanted.map((node) => topics.subscribe('node', { node }, listener));
      return () => ends.forEach((end) => end());
    },
    snapshot() {
      const now = read();
      if (now.length !== last.length || now.some((one, index) => one !== last[index])) last = now;
      return last;
    },
  };
}
