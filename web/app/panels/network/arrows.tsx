import type { NodeId } from '../../../protocol/messages';
import { shownRate } from '../../../core/numbers';
import { arrowPath, arrowWidth, kNobody, type Flow, type Picture } from '../../../core/traffic';
import { words } from './words';
import { gapIn, hubOf, straight, stub } from './paths';
import type { NetworkState } from './use_network';

/** More arrows than these cannot be told apart: each node then has one to the bus and one from it. */
const kPairsMax = 40;

/** Who talks to whom; of chosen nodes all, in two colours: what they say, what they hear. */
export function Arrows(props: {
  network: NetworkState;
  picture: Picture;
  chosen: readonly NodeId[];
}) {
  const { network, picture, chosen } = props;
  const { flows } = network;
  const own = flows.filter(({ from, to }) => chosen.includes(from) || chosen.includes(to));
  const shown = chosen.length > 0 ? own : flows;
  if (usesSpokes(network, chosen)) return <Spokes network={network} picture={picture} />;
  return (
    <g className="net__arrows">
      {shown.slice(0, kPairsMax * 3).map((flow) => (
        <Arrow
          key={`${flow.from} ${flow.to}`}
          flow={flow}
          network={network}
          picture={picture}
          kind={chosen.length === 0 ? 'all' : chosen.includes(flow.from) ? 'out' : 'in'}
        />
      ))}
    </g>
  );
}

/** Too many pairs to be told apart: each node then talks with the bus. */
export function usesSpokes({ flows }: NetworkState, chosen: readonly NodeId[]): boolean {
  return flows.length > kPairsMax && chosen.length === 0;
}

function Arrow({
  flow,
  network,
  picture,
  kind,
}: {
  flow: Flow;
  network: NetworkState;
  picture: Picture;
  kind: 'all' | 'out' | 'in';
}) {
  const from = picture.spots.get(flow.from);
  const to = flow.to === kNobody ? undefined : picture.spots.get(flow.to);
  if (!from) return null;
  const label = words.arrow(
    network.nameOf(flow.from),
    network.nameOf(flow.to),
    shownRate(flow.rate),
    flow.events.join(', '),
  );
  return (
    <path
      className={`net__arrow net__arrow--${kind}`}
      // What nobody has a handler for ends soon.
      d={to ? arrowPath(from, to, picture.centre, gapIn(picture)) : stub(from, picture)}
      strokeWidth={arrowWidth(flow.rate)}
      markerEnd={`url(#net-${kind})`}
    >
      <title>{label}</title>
    </path>
  );
}

/** To the bus as much as it says, from the bus as much as it hears. */
function Spokes({ network, picture }: { network: NetworkState; picture: Picture }) {
  const hub = hubOf(picture);
  const thin = Math.min(1, 30 / picture.spots.size);
  return (
    <g className="net__arrows">
      {[...picture.spots].flatMap(([id, spot]) => {
        const talk = network.talk.get(id);
        if (!talk) return [];
        return [
          talk.said > 0 ? (
            <path
              key={`${id} out`}
              className="net__arrow net__arrow--out"
              d={straight(spot, hub, picture, 3)}
              strokeWidth={arrowWidth(talk.says) * thin}
              markerEnd="url(#net-out)"
            />
          ) : null,
          talk.heard > 0 ? (
            <path
              key={`${id} in`}
              className="net__arrow net__arrow--in"
              d={straight(hub, spot, picture, 3)}
              strokeWidth={arrowWidth(talk.hears) * thin}
              markerEnd="url(#net-in)"
            />
          ) : null,
        ];
      })}
    </g>
  );
}
