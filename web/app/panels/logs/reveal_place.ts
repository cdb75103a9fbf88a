import type { LogPlace } from '../../../core/logs';
import type { Studio } from '../../../core/studio';
import { revealDoc } from '../../../core/window_state';
import { revealElement } from '../../views/plan/reveal_element';

/** Its line or element comes in sight; the keyboard stays where it is. */
export function revealPlace(studio: Studio, place: LogPlace): void {
  if (place.is === 'line')
    revealDoc(studio.window, place.doc, { line: place.line, column: 1 }, false);
  else revealElement(studio, place.doc, place.element, false);
}
