// The picture of the network: where each node is around the bus, which talks to which, and how much.

import type { Node, NodeId, Traffic } from '../protocol/messages';

/** A host on the bus: what is said from 0 comes from it. */
export const kHost = 0;

export interface Flow {
  from: NodeId;
  /** kNobody: nobody has a handler for it. */
  to: NodeId;
  count: number;
  rate: number;
  events: string[];
}
export const kNobody = -1;

/** Rates over the last seconds from looks at the counts; counts that went back began again. */
export class Rates {
  private looks: { at: number; counts: Map<string, number> }[] = [];

  take(traffic: readonly Traffic[], now: number): void {
    const counts = new Map(traffic.map((one) => [keyOf(one), one.count]));
    const last = this.looks.at(-1);
    const wentBack = [...(last?.counts ?? [])].some(
      ([key, count]) => (counts.get(key) ?? 0) < count,
    );
    if (wentBack) this.looks = [];
    this.looks.push({ at: now, counts });
    // One look from before the last seconds stays, so that there is always something to compare.
    while ((this.looks[1]?.at ?? now) < now - kRateMs) this.looks.shift();
  }

  rateOf(one: Traffic): number {
    const [first, last] = [this.looks[0], this.looks.at(-1)];
    const passed = ((last?.at ?? 0) - (first?.at ?? 0)) / 1000;
    if (!first || passed < 0.5) return 0;
    const key = keyOf(one);
    return ((last?.counts.get(key) ?? 0) - (first.counts.get(key) ?? 0)) / passed;
  }
}
const kRateMs = 5000;

/** One flow for each pair that talks, the strongest first. */
export function flowsOf(traffic: readonly Traffic[], rateOf: (one: Traffic) => number): Flow[] {
  const flows = new Map<string, Flow>();
  for (const one of traffic) {
    const others = one.to.filter((node) => node !== one.from);
    for (const to of others.length > 0 ? others : [kNobody]) {
      const key = `${one.from} ${to}`;
      const flow = flows.get(key) ?? { from: one.from, to, count: 0, rate: 0, events: [] };
      flow.count += one.count;
      flow.rate += rateOf(one);
      flow.events.push(one.event);
      flows.set(key, flow);
    }
  }
  return [...flows.values()].sort((a, b) => b.rate - a.rate || b.count - a.count);
}

/** What a node says and hears, in all. */
export function talkOf(
  traffic: readonly Traffic[],
  rateOf: (one: Traffic) => number,
): Map<NodeId, { says: number; hears: number; said: number; heard: number }> {
  const talk = new Map<NodeId, { says: number; hears: number; said: number; heard: number }>();
  const entry = (node: NodeId) => {
    const known = talk.get(node) ?? { says: 0, hears: 0, said: 0, heard: 0 };
    talk.set(node, known);
    return known;
  };
  for (const one of traffic) {
    const rate = rateOf(one);
    entry(one.from).says += rate;
    entry(one.from).said += one.count;
    for (const to of one.to) {
      if (to === one.from) continue;
      entry(to).hears += rate;
      entry(to).heard += one.count;
    }
  }
  return talk;
}

/** Pixels of an arrow: 1 to 6, with the logarithm of what flows. */
export function arrowWidth(rate: number): number {
  return Math.min(6, 1 + 1.6 * Math.log10(1 + Math.max(0, rate)));
}

export interface Spot {
  x: number;
  y: number;
  /** Of the line from the middle to it, in radians. */
  angle: number;
}

export interface Picture {
  width: number;
  height: number;
  centre: { x: number; y: number };
  /** Boxes with names in them, or signs with names that point outwards like rays. */
  form: 'boxes' | 'rays';
  /** The bus, on which they are. */
  ring: { x: number; y: number };
  spots: Map<NodeId, Spot>;
}

/** As many nodes have boxes; more are drawn as signs. */
export const kBoxesMax = 14;
export const kBox = { width: 108, height: 40 };
const kRayGap = 13.5;
const kRayLength = 98;

/** Where nodes are drawn around the bus, in an area of that size at least; grows with their number. */
export function pictureOf(
  nodes: readonly NodeId[],
  area: { width: number; height: number },
): Picture {
  return nodes.length <= kBoxesMax ? boxes(nodes, area) : rays(nodes, area);
}

function boxes(nodes: readonly NodeId[], area: { width: number; height: number }): Picture {
  const rows = Math.ceil(nodes.length / 2);
  let width = Math.max(360, Math.min(area.width, 240 + nodes.length * 64));
  let height = Math.max(nodes.length <= 2 ? 120 : 200, Math.min(area.height, 130 + rows * 56));
  // On an ellipse some are closer than others: it grows until no box touches another.
  for (let turn = 0; turn < kGrowthsMax; turn++) {
    const picture = ellipse(nodes, width, height);
    if (boxesApart([...picture.spots.values()])) return picture;
    height *= 1.06;
    width *= 1.03;
  }
  return ellipse(nodes, width, height);
}
const kGrowthsMax = 30;

function ellipse(nodes: readonly NodeId[], width: number, height: number): Picture {
  const centre = { x: width / 2, y: height / 2 };
  const [rx, ry] = [(width - kBox.width) / 2 - 10, (height - kBox.height) / 2 - 10];
  const spots = new Map(
    nodes.map((node, index): [NodeId, Spot] => {
      const angle =
        nodes.length === 1 ? Math.PI : startAt(nodes.length) + turn(index, nodes.length);
      return [
        node,
        { x: centre.x + rx * Math.cos(angle), y: centre.y + ry * Math.sin(angle), angle },
      ];
    }),
  );
  // Two are at the ends of a line.
  const ring = { x: rx, y: nodes.length <= 2 ? 0.5 : ry };
  return { width, height, centre, form: 'boxes', ring, spots };
}

function boxesApart(spots: readonly Spot[]): boolean {
  return spots.every((a, index) =>
    spots
      .slice(index + 1)
      .every(
        (b) =>
          Math.abs(a.x - b.x) >= kBox.width + kBoxGap ||
          Math.abs(a.y - b.y) >= kBox.height + kBoxGap,
      ),
  );
}
const kBoxGap = 12;

/** Two nodes are drawn left and right; from three on the first one is at the top left. */
function startAt(count: number): number {
  return count <= 2 ? Math.PI : -Math.PI / 2 - Math.PI / count;
}

function turn(index: number, count: number): number {
  return (index * 2 * Math.PI) / count;
}

function rays(nodes: readonly NodeId[], area: { width: number; height: number }): Picture {
  const least = Math.max(110, (nodes.length * kRayGap) / (2 * Math.PI));
  const fits = Math.min(area.width, area.height) / 2 - kRayLength;
  const radius = Math.min(Math.max(least, fits), Math.max(least * 1.4, 280));
  const size = 2 * (radius + kRayLength);
  const centre = { x: size / 2, y: size / 2 };
  const spots = new Map(
    nodes.map((node, index): [NodeId, Spot] => {
      const angle = -Math.PI / 2 + turn(index, nodes.length);
      return [
        node,
        {
          x: centre.x + radius * Math.cos(angle),
          y: centre.y + radius * Math.sin(angle),
          angle,
        },
      ];
    }),
  );
  return { width: size, height: size, centre, form: 'rays', ring: { x: radius, y: radius }, spots };
}

/** An arrow between two spots, bent towards the middle, ending before what is there. */
export function arrowPath(
  from: Spot,
  to: Spot,
  centre: { x: number; y: number },
  gap: (spot: Spot, towards: { x: number; y: number }) => number,
): string {
  const middle = { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 };
  // A little to one side, so that there and back are two arrows.
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const length = Math.hypot(dx, dy) || 1;
  const bend = {
    x: middle.x + (centre.x - middle.x) * 0.35 - (dy / length) * 14,
    y: middle.y + (centre.y - middle.y) * 0.35 + (dx / length) * 14,
  };
  const start = apart(from, bend, gap(from, bend));
  const end = apart(to, bend, gap(to, bend) + 5);
  return `M${round(start.x)} ${round(start.y)}Q${round(bend.x)} ${round(bend.y)} ${round(end.x)} ${round(end.y)}`;
}

function apart(spot: Spot, towards: { x: number; y: number }, by: number) {
  const [dx, dy] = [towards.x - spot.x, towards.y - spot.y];
  const length = Math.hypot(dx, dy) || 1;
  return { x: spot.x + (dx / length) * by, y: spot.y + (dy / length) * by };
}

/** How far it is from the middle of a box to its border, in a direction. */
export function boxGap(spot: { x: number; y: number }, towards: { x: number; y: number }): number {
  const [dx, dy] = [Math.abs(towards.x - spot.x), Math.abs(towards.y - spot.y)];
  const length = Math.hypot(dx, dy) || 1;
  const across = dx > 0 ? (kBox.width / 2) * (length / dx) : Infinity;
  const down = dy > 0 ? (kBox.height / 2) * (length / dy) : Infinity;
  return Math.min(across, down);
}

/** All that are on the bus: nodes by number, and the host if it has said something. */
export function partners(
  nodes: readonly Pick<Node, 'id'>[],
  traffic: readonly Traffic[],
): NodeId[] {
  const ids = nodes.map((node) => node.id).sort((a, b) => a - b);
  return traffic.some((one) => one.from === kHost) ? [kHost, ...ids] : ids;
}

function keyOf({ from, event }: Traffic): string {
  return `${from} ${event}`;
}

function round(value: number): number {
  return Math.round(value * 10) / 10;
}
