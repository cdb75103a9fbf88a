// The colours of a world in both themes: the frame's are tokens, those of things are their own, a
// little darker or lighter, so that the picture fits into the window.

import type { Colour } from '../../../protocol/messages';
import type { Thing } from '../../../core/world/stage';

export interface Colours {
  dark: boolean;
  sky: string;
  wall: string;
  wallSide: string;
  robot: string;
  robotSide: string;
  trail: string;
  cone: string;
  accent: string;
  front: string;
  text: string;
  surface: string;
  muted: string;
}

export function readColours(): Colours {
  const style = getComputedStyle(document.documentElement);
  const token = (name: string) => style.getPropertyValue(name).trim();
  return {
    dark: document.documentElement.dataset['theme'] !== 'light',
    sky: token('--world-sky'),
    wall: token('--world-wall-top'),
    wallSide: token('--world-wall-side'),
    robot: token('--world-robot-top'),
    robotSide: token('--world-robot-side'),
    trail: token('--world-trail'),
    cone: token('--world-cone'),
    accent: token('--world-trail'),
    front: token('--raised-fill'),
    text: token('--text-primary'),
    surface: token('--surface-raised'),
    muted: token('--text-muted'),
  };
}

/** Dark: the ground is dimmed. Light: all is lighter, and black stays black. */
export function shown(colour: Colour, ground: boolean, dark: boolean): Colour {
  return colour.map((part) =>
    dark ? part * (ground ? 0.87 : 1) : Math.pow(Math.max(part, 0), 0.78),
  );
}

export function css(colour: Colour, alpha = 1): string {
  const [red = 0, green = 0, blue = 0] = colour.map((part) => Math.round(part * 255));
  return `rgb(${red} ${green} ${blue} / ${alpha})`;
}

export function fillOf(thing: Thing, colours: Colours): string {
  return css(shown(thing.colour, thing.kind === 'patch', colours.dark));
}

/** The same, darker: sides and outlines. */
export function edgeOf(thing: Thing, colours: Colours): string {
  return css(shown(thing.colour, false, colours.dark).map((part) => part * 0.72));
}

/** Lines on the ground are seen on light and on dark ground. */
export function gridOf(ground: Colour, dark: boolean): string {
  const [red = 0, green = 0, blue = 0] = ground;
  const bright = 0.3 * red + 0.6 * green + 0.1 * blue > 0.45;
  return bright ? css([0, 0, 0], dark ? 0.09 : 0.07) : css([1, 1, 1], 0.1);
}
