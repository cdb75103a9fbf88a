// Things found by where they are: kept in squares of the canvas.

import type { Box } from './shape';

/** Side of the squares. */
const kCell = 256;

export class Cells<Thing> {
  private readonly cells = new Map<string, Thing[]>();

  put(box: Box, thing: Thing): void {
    for (const key of keysOf(box)) {
      const cell = this.cells.get(key);
      if (cell) cell.push(thing);
      else this.cells.set(key, [thing]);
    }
  }

  near(area: Box): Set<Thing> {
    return new Set(keysOf(area).flatMap((key) => this.cells.get(key) ?? []));
  }
}

function keysOf({ x, y, width, height }: Box): string[] {
  const keys: string[] = [];
  for (let row = Math.floor(y / kCell); row <= Math.floor((y + height) / kCell); row++)
    for (let column = Math.floor(x / kCell); column <= Math.floor((x + width) / kCell); column++)
      keys.push(`${column} ${row}`);
  return keys;
}
