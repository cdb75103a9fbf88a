// What the views of the network share: nodes, traffic with its rates, flows.

import { useCallback, useMemo, useState, useSyncExternalStore } from 'react';
import type { Link, Node, NodeId, Topics, Traffic } from '../../../protocol/messages';
import { flowsOf, kHost, kNobody, Rates, talkOf, type Flow } from '../../../core/traffic';
import { useStudio, useTopic } from '../../hooks';
import { words } from './words';

export interface NetworkState {
  nodes: readonly Node[];
  links: readonly Link[];
  traffic: readonly Traffic[];
  flows: readonly Flow[];
  talk: ReturnType<typeof talkOf>;
  rateOf(one: Traffic): number;
  nameOf(node: NodeId): string;
}

export function useNetwork(shown: boolean): NetworkState {
  const nodes = useTopic('robot', {})?.nodes;
  const [rates] = useState(() => new Rates());
  const network = useCounted(shown, rates);
  return useMemo(() => {
    const traffic = network?.traffic ?? [];
    const rateOf = (one: Traffic) => rates.rateOf(one);
    const names = new Map((nodes ?? []).map((node) => [node.id, node.name]));
    return {
      nodes: nodes ?? [],
      links: network?.links ?? [],
      traffic,
      flows: flowsOf(traffic, rateOf),
      talk: talkOf(traffic, rateOf),
      rateOf,
      nameOf: (node) =>
        node === kHost
          ? words.host
          : node === kNobody
            ? words.nobody
            : (names.get(node) ?? String(node)),
    };
  }, [nodes, network, rates]);
}

/** The traffic; each report is counted when it comes, however often the panel is drawn. */
function useCounted(shown: boolean, rates: Rates): Topics['network']['is'] | undefined {
  const { topics } = useStudio();
  const subscribe = useCallback(
    (listener: () => void) => {
      if (!shown) return () => {};
      return topics.subscribe('network', {}, () => {
        const told = topics.get('network', {});
        if (told) rates.take(told.traffic, performance.now());
        listener();
      });
    },
    [topics, shown, rates],
  );
  return useSyncExternalStore(subscribe, () => (shown ? topics.get('network', {}) : undefined));
}
