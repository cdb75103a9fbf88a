import { useEffect, useRef, type RefObject } from 'react';
import { distance, reachOf } from '../../../core/world/geometry';
import { thingAt } from '../../../core/world/hit';
import type { WorldModel } from '../../../core/world/model';
import { handleOf, panned, toScreen, toWorld, zoomed } from '../../../core/world/view';
import { useStudio } from '../../hooks';
import { readColours, type Colours } from './colours';
import { drawWorld, kHandlePx } from './draw';
import { optionsOf, type WorldOptions } from './options';
import type { Eye } from './use_hands';

/** A press so near a thing still means it, in pixels. */
const kSlackPx = 6;

/** The world from above, drawn when something has changed, at most once a frame. */
export function FlatView({ model, eyeRef }: { model: WorldModel; eyeRef: RefObject<Eye | null> }) {
  const studio = useStudio();
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    if (!canvas.current) return;
    eyeRef.current = eyeOf(model);
    const end = drawOn(canvas.current, model, () => optionsOf(studio).getState());
    const off = optionsOf(studio).subscribe(() => model.drawn.emit());
    return () => {
      eyeRef.current = null;
      off();
      end();
    };
  }, [studio, model, eyeRef]);
  return <canvas className="world__canvas" ref={canvas} aria-hidden />;
}

function eyeOf(model: WorldModel): Eye {
  const look = (view: Parameters<WorldModel['look']>[0]) => {
    model.follows = null;
    model.look(view);
  };
  return {
    meet(at) {
      const view = model.seen();
      const ground = toWorld(view, model.screen, at);
      const chosen = model.chosen;
      const pose = chosen && model.poseOf(chosen);
      const handle = pose && handleOf(pose, reachOf(chosen.shape), view.scale);
      return {
        ground,
        hit: thingAt(model.standing(), ground, kSlackPx / view.scale),
        onHandle: handle
          ? distance(toScreen(view, model.screen, handle), at) <= kHandlePx + 3
          : false,
      };
    },
    pan: (by) => look(panned(model.seen(), by)),
    zoom: (at, factor) => model.look(zoomed(model.seen(), model.screen, at, factor)),
    hold() {},
  };
}

function drawOn(
  canvas: HTMLCanvasElement,
  model: WorldModel,
  options: () => WorldOptions,
): () => void {
  const context = canvas.getContext('2d');
  let colours: Colours = readColours();
  let asked = 0;
  const draw = () => {
    asked = 0;
    if (!context || model.screen.width === 0) return;
    model.trails.limit = options().trailLength || Infinity;
    drawWorld(context, model, options(), colours, ratioOf(canvas, model));
  };
  const ask = () => {
    if (asked === 0) asked = requestAnimationFrame(draw);
  };
  const resizes = new ResizeObserver(([entry]) => {
    if (!entry) return;
    const { width, height } = entry.contentRect;
    const ratio = window.devicePixelRatio || 1;
    canvas.width = Math.max(1, Math.round(width * ratio));
    canvas.height = Math.max(1, Math.round(height * ratio));
    model.resize({ width, height });
    // At once: a canvas that got a new size is empty.
    cancelAnimationFrame(asked);
    draw();
  });
  resizes.observe(canvas);
  const themes = new MutationObserver(() => {
    colours = readColours();
    ask();
  });
  themes.observe(document.documentElement, { attributeFilter: ['data-theme'] });
  const off = model.drawn.on(ask);
  ask();
  return () => {
    off();
    resizes.disconnect();
    themes.disconnect();
    cancelAnimationFrame(asked);
  };
}

function ratioOf(canvas: HTMLCanvasElement, model: WorldModel): number {
  return canvas.width / Math.max(model.screen.width, 1);
}
