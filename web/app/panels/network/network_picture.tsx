import { useMemo } from 'react';
import type { Node, NodeId } from '../../../protocol/messages';
import { shownRate } from '../../../core/numbers';
import { partners, pictureOf, type Picture } from '../../../core/traffic';
import { update } from '../../../core/window_state';
import { useStudio, useWindow } from '../../hooks';
import { useNodeWord } from '../../robot_hooks';
import { words } from './words';
import { NodeBox, NodeRay } from './node_shapes';
import { Arrows, usesSpokes } from './arrows';
import { Hub, Markers, Ring } from './hub';
import type { NetworkState } from './use_network';

/** Laid out again only for other nodes or another room; `ids` are their numbers. */
function usePicture(ids: string, area: { width: number; height: number }): Picture {
  return useMemo(() => pictureOf(ids.split(' ').map(Number), area), [ids, area]);
}

/** The bus in the middle, the nodes around it, arrows for who talks to whom. */
export function NetworkPicture({
  network,
  area,
}: {
  network: NetworkState;
  area: { width: number; height: number };
}) {
  const { window: store } = useStudio();
  const chosen = useWindow((state) => state.chosenNodes);
  const ids = partners(network.nodes, network.traffic);
  const picture = usePicture(ids.join(' '), area);
  const choose = (id: NodeId) =>
    update(store, (draft) => {
      draft.chosenNodes = draft.chosenNodes.length === 1 && draft.chosenNodes[0] === id ? [] : [id];
    });
  return (
    <svg
      className={chosen.length > 0 ? 'net is-chosen' : 'net'}
      width={picture.width}
      height={picture.height}
      viewBox={`0 0 ${picture.width} ${picture.height}`}
      role="group"
      aria-label={words.picture(network.nodes.length)}
    >
      <Markers />
      <Ring picture={picture} />
      <Arrows network={network} picture={picture} chosen={chosen} />
      {usesSpokes(network, chosen) ? <Hub picture={picture} /> : null}
      {ids.map((id) => (
        <Partner
          key={id}
          id={id}
          node={network.nodes.find((node) => node.id === id)}
          network={network}
          picture={picture}
          chosen={chosen.includes(id)}
          onChoose={() => choose(id)}
        />
      ))}
    </svg>
  );
}

function Partner({
  id,
  node,
  network,
  picture,
  chosen,
  onChoose,
}: {
  id: NodeId;
  node: Node | undefined;
  network: NetworkState;
  picture: Picture;
  chosen: boolean;
  onChoose(): void;
}) {
  const spot = picture.spots.get(id);
  const wordOf = useNodeWord();
  if (!spot) return null;
  const { says = 0, hears = 0 } = network.talk.get(id) ?? {};
  const state = node ? wordOf(node.state) : words.hostHelp;
  const name = network.nameOf(id);
  // The title is the accessible name, and the tip.
  const label = `${name} ${id === 0 ? '' : id}, ${state}, ${words.says} ${shownRate(says)}${words.aSecond}, ${words.hears} ${shownRate(hears)}${words.aSecond}`;
  const props = { spot, node, name, state, chosen };
  return (
    <g
      className="net__node"
      role="button"
      tabIndex={0}
      aria-pressed={chosen}
      onClick={onChoose}
      onKeyDown={(event) => {
        if (event.key !== 'Enter' && event.key !== ' ') return;
        event.preventDefault();
        onChoose();
      }}
    >
      <title>{label}</title>
      {picture.form === 'boxes' ? <NodeBox {...props} id={id} /> : <NodeRay {...props} id={id} />}
    </g>
  );
}
