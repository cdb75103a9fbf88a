// The ways of arrows in the picture of the network.

import { boxGap, type Picture, type Spot } from '../../../core/traffic';
import { hubRadius } from './hub';

/** A short arrow towards the middle. */
export function stub(from: Spot, picture: Picture): string {
  const { centre } = picture;
  const gap = gapIn(picture)(from, centre);
  const [dx, dy] = [centre.x - from.x, centre.y - from.y];
  const length = Math.hypot(dx, dy) || 1;
  const at = (by: number) =>
    `${(from.x + (dx / length) * by).toFixed(1)} ${(from.y + (dy / length) * by).toFixed(1)}`;
  return `M${at(gap)}L${at(gap + 16)}`;
}

export function hubOf({ centre }: Picture): Spot {
  return { ...centre, angle: 0 };
}

export function gapIn(picture: Picture) {
  const { form, centre } = picture;
  return (spot: Spot, towards: { x: number; y: number }) => {
    if (spot.x === centre.x && spot.y === centre.y) return hubRadius(picture) + 6;
    return form === 'boxes' ? boxGap(spot, towards) + 3 : 11;
  };
}

export function straight(from: Spot, to: Spot, picture: Picture, aside: number): string {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const length = Math.hypot(dx, dy) || 1;
  const gap = gapIn(picture);
  const [start, end] = [gap(from, to), length - gap(to, from) - 5];
  const at = (by: number) =>
    `${(from.x + (dx / length) * by - (dy / length) * aside).toFixed(1)} ${(from.y + (dy / length) * by + (dx / length) * aside).toFixed(1)}`;
  return `M${at(start)}L${at(end)}`;
}
