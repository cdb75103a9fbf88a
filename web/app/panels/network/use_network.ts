// What the views of the network share: nodes, traffic with its rates, flows.

import { useMemo, useState } from 'react';
import type { Link, Node, NodeId, Traffic } from '../../../protocol/messages';
import { flowsOf, kHost, kNobody, Rates, talkOf, type Flow } from '../../../core/traffic';
import { useTopic } from '../../hooks';
import { text } from '../../text';

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
  const network = useTopic('network', shown ? {} : null);
  const [rates] = useState(() => new Rates());
  return useMemo(() => {
    const traffic = network?.traffic ?? [];
    if (network) rates.take(traffic, performance.now());
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
          ? text.network.host
          : node === kNobody
            ? text.network.nobody
            : (names.get(node) ?? String(node)),
    };
  }, [nodes, network, rates]);
}
