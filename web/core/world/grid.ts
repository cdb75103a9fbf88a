// Many robots of one entry of a world file, `"grid": [columns, rows]`. The same as
// src/sim/robot_grid.cpp.

import type { Json } from '../../protocol/messages';

export interface Standing {
  name: string;
  x: number;
  y: number;
}

/** As many are shown; a file with more of them still runs. */
export const kShownMax = 10_000;

/** The robots of an entry that stands at `first`: itself alone, or by rows from it. */
export function robotsOfEntry(entry: Record<string, Json>, first: Standing): Standing[] {
  const grid = pairIn(entry['grid']);
  if (!grid) return [first];
  const spacing = entry['spacing'];
  const [dx, dy] = typeof spacing === 'number' ? [spacing, spacing] : (pairIn(spacing) ?? [0, 0]);
  const columns = Math.max(1, Math.floor(grid[0]));
  const rows = Math.max(1, Math.floor(grid[1]));
  const count = Math.min(columns * rows, kShownMax);
  return Array.from({ length: count }, (_, index) => ({
    name: `${first.name}${index + 1}`,
    x: first.x + (index % columns) * dx,
    y: first.y + Math.floor(index / columns) * dy,
  }));
}

function pairIn(value: Json | undefined): [number, number] | null {
  if (!Array.isArray(value) || value.length !== 2) return null;
  const [a, b] = value;
  return typeof a === 'number' && typeof b === 'number' ? [a, b] : null;
}
