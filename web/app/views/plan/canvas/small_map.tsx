import { MiniMap, useStore, type PanelPosition } from '@xyflow/react';
import type { PlanBoard } from '../../../../core/plan/board';
import { overlaps, type Box } from '../../../../core/plan/shape';
import { drawWords } from '../words';

const corners: readonly PanelPosition[] = ['bottom-right', 'bottom-left', 'top-right', 'top-left'];
/** With its distance from the border. */
const kSize = { width: 150, height: 110 };

/** The whole plan, small: in a corner where it covers no element, and only while some of the plan is out of sight. */
export function SmallMap({ board }: { board: PlanBoard }) {
  const corner = useStore(({ transform: [x, y, zoom], width, height }) =>
    freeCorner(
      boxesOf(board).map((box) => ({
        x: box.x * zoom + x,
        y: box.y * zoom + y,
        width: box.width * zoom,
        height: box.height * zoom,
      })),
      { width, height },
    ),
  );
  return corner === null ? null : (
    <MiniMap pannable zoomable position={corner} ariaLabel={drawWords.map} />
  );
}

function boxesOf({ scene: { start, actors, pills }, notes }: PlanBoard): Box[] {
  return [
    ...[start, ...actors].map((block) => block.whole),
    ...pills.map(({ box }) => box),
    ...notes.map(({ at, size }) => ({ x: at[0], y: at[1], width: size[0], height: size[1] })),
  ];
}

/** On the screen. */
function freeCorner(
  boxes: readonly Box[],
  { width, height }: { width: number; height: number },
): PanelPosition | null {
  const inSight = ({ x, y, width: w, height: h }: Box) =>
    x >= 0 && y >= 0 && x + w <= width && y + h <= height;
  if (boxes.every(inSight)) return null;
  const free = corners.find((corner) => {
    const map = {
      x: corner.endsWith('right') ? width - kSize.width : 0,
      y: corner.startsWith('bottom') ? height - kSize.height : 0,
      ...kSize,
    };
    return !boxes.some((box) => overlaps(box, map));
  });
  return free ?? null;
}
