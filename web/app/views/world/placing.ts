import type { Placing } from '../../../core/world/model';
import { disc, rectangle, type Shape } from '../../../core/world/geometry';
import { bodies, kLampRadius } from '../../../core/world/stage';

/** What is about to be put down, as it will be there (core/world/file.ts, newObject). */
export function shapeOfPlacing(placing: Placing): { shape: Shape } {
  if (placing.what === 'robot') return { shape: bodies[placing.type].shape };
  switch (placing.kind) {
    case 'wall':
      return { shape: rectangle(0.5, 0.05) };
    case 'box':
      return { shape: rectangle(0.2, 0.2) };
    case 'cylinder':
    case 'patch':
      return { shape: disc(0.1) };
    case 'light':
    case 'infrared':
      return { shape: disc(kLampRadius) };
  }
}
