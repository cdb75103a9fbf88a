// Of a large plan only the arrows that can be seen are drawn. What is seen is rounded up to tiles:
// moving within them changes nothing.

import { useStore, type ReactFlowState } from '@xyflow/react';
import { useMemo } from 'react';
import type { Arrow, Drawing } from '../../../../core/plan/arrows';
import { around, overlaps, type Box, type Point } from '../../../../core/plan/shape';
import { kManyNodes } from './distance';

const kTile = 1000; // of the canvas, in its own units

/** All of a plan that is not large. */
export function useSeenArrows({ arrows, routes }: Drawing): readonly Arrow[] {
  const many = arrows.length > kManyNodes;
  const seen = useStore((state) => (many ? JSON.stringify(tilesOf(state)) : ''));
  const areas = useMemo(
    () => new Map([...routes].map(([id, { points }]) => [id, around(points.map(spot))])),
    [routes],
  );
  return useMemo(() => {
    if (!seen) return arrows;
    const now = JSON.parse(seen) as Box;
    return arrows.filter(({ id }) => overlaps(areas.get(id) ?? kNowhere, now));
  }, [arrows, areas, seen]);
}

const spot = ({ x, y }: Point): Box => ({ x, y, width: 0, height: 0 });
const kNowhere: Box = { x: NaN, y: NaN, width: 0, height: 0 };

function tilesOf({ transform, width, height }: ReactFlowState): Box {
  const [left, top, zoom] = transform;
  const down = (pixels: number) => Math.floor(pixels / zoom / kTile) * kTile;
  const x = down(-left);
  const y = down(-top);
  return { x, y, width: down(width - left) + kTile - x, height: down(height - top) + kTile - y };
}
