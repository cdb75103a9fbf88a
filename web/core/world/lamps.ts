// The lamps of robots that are lit, as both views of a world draw them.

import type { Colour } from '../../protocol/messages';
import { placed, reachOf, type Point } from './geometry';
import type { WorldModel } from './model';

export interface Lit {
  at: Point;
  /** Of the robot: lamps are on its roof. */
  height: number;
  radius: number;
  colour: Colour;
  /** The same hue, as bright as it is seen on a screen. */
  core: Colour;
}

const kDark = 0.02;
/** A lamp that is dimmer than this keeps being told apart from a bright one. */
const kBright = 0.35;

export function litLamps(model: WorldModel): Lit[] {
  return model.lamps.flatMap(({ robot, at, colour }) => {
    const thing = model.robotAt(robot);
    const brightest = Math.max(...colour);
    if (!thing || brightest < kDark) return [];
    const [red = 0, green = 0, blue = 0] = colour;
    const by = Math.max(brightest, kBright);
    return [
      {
        at: placed(at, model.poseOf(thing)),
        height: thing.height,
        radius: reachOf(thing.shape) * 0.14,
        colour,
        core: [red / by, green / by, blue / by],
      },
    ];
  });
}
