// The picture from above, on a plain canvas: from the ground up, from the model, without React.

import { placed, reachOf, shownDegrees, type Point, type Pose } from '../../../core/world/geometry';
import { litLamps } from '../../../core/world/lamps';
import type { WorldModel } from '../../../core/world/model';
import { isLamp, type Thing } from '../../../core/world/stage';
import {
  gridStep,
  handleOf,
  kWall,
  lengthText,
  toScreen,
  type View,
} from '../../../core/world/view';
import { css, edgeOf, fillOf, gridOf, shown, type Colours } from './colours';
import type { WorldOptions } from './options';
import { shapeOfPlacing } from './placing';

/** A sonar hears so far to each side of its axis, in rad. */
export const kConeHalf = (12 * Math.PI) / 180;
export const kHandlePx = 6;

interface Scene {
  ctx: CanvasRenderingContext2D;
  model: WorldModel;
  options: WorldOptions;
  colours: Colours;
  view: View;
}

export function drawWorld(
  ctx: CanvasRenderingContext2D,
  model: WorldModel,
  options: WorldOptions,
  colours: Colours,
  ratio: number,
): void {
  const { width, height } = model.screen;
  const view = model.seen();
  const scene: Scene = { ctx, model, options, colours, view };
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.fillStyle = colours.sky;
  ctx.fillRect(0, 0, width, height);
  if (model.stage.things.length === 0 && model.stage.name === '' && model.t === 0) return;
  // Metres, y up, from here on.
  ctx.setTransform(
    ratio * view.scale,
    0,
    0,
    -ratio * view.scale,
    ratio * (width / 2 - view.x * view.scale),
    ratio * (height / 2 + view.y * view.scale),
  );
  drawGround(scene);
  for (const { thing, pose } of model.standing()) {
    if (thing.kind === 'robot') continue;
    drawThing(scene, thing, pose);
  }
  if (options.trails) drawTrails(scene);
  if (options.rays) drawRays(scene);
  for (const { thing, pose } of model.standing())
    if (thing.kind === 'robot') drawRobot(scene, thing, pose);
  drawNow(scene);
  drawLamps(scene);
  drawPlacing(scene);
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  drawMarks(scene);
  drawScale(scene);
}

function drawGround({ ctx, model, options, colours, view }: Scene): void {
  const { width, height, open, ground } = model.stage;
  if (!open) {
    ctx.fillStyle = colours.wall;
    ctx.fillRect(-kWall, -kWall, width + 2 * kWall, height + 2 * kWall);
    ctx.fillStyle = colours.wallSide;
    ctx.fillRect(-kWall / 3, -kWall / 3, width + (2 * kWall) / 3, height + (2 * kWall) / 3);
  }
  ctx.fillStyle = css(shown(ground, true, colours.dark));
  ctx.fillRect(0, 0, width, height);
  if (model.image) {
    ctx.save();
    ctx.scale(1, -1);
    ctx.globalAlpha = colours.dark ? 0.9 : 1;
    ctx.drawImage(model.image, 0, -height, width, height);
    ctx.restore();
  }
  if (!options.grid) return;
  const step = gridStep(view.scale);
  ctx.beginPath();
  for (let x = step; x < width - 1e-6; x += step) line(ctx, { x, y: 0 }, { x, y: height });
  for (let y = step; y < height - 1e-6; y += step) line(ctx, { x: 0, y }, { x: width, y });
  ctx.strokeStyle = gridOf(ground, colours.dark);
  ctx.lineWidth = 1 / view.scale;
  ctx.stroke();
}

function drawThing({ ctx, colours, view }: Scene, thing: Thing, pose: Pose): void {
  ctx.beginPath();
  shapePath(ctx, thing, pose);
  if (thing.later) {
    ctx.setLineDash([5 / view.scale, 4 / view.scale]);
    ctx.strokeStyle = edgeOf(thing, colours);
    ctx.lineWidth = 1.5 / view.scale;
    ctx.globalAlpha = 0.3;
    ctx.fillStyle = fillOf(thing, colours);
    ctx.fill();
    ctx.globalAlpha = 1;
    ctx.stroke();
    ctx.setLineDash([]);
    return;
  }
  if (isLamp(thing.kind)) return drawLight({ ctx, colours, view }, thing, pose);
  ctx.fillStyle = fillOf(thing, colours);
  ctx.fill();
  if (thing.kind === 'patch') return;
  ctx.strokeStyle = edgeOf(thing, colours);
  ctx.lineWidth = Math.min(1.5 / view.scale, 0.01);
  ctx.stroke();
}

/** A lamp shines, a beacon sends waves; one that is off is a ring. */
function drawLight(
  { ctx, colours, view }: Pick<Scene, 'ctx' | 'colours' | 'view'>,
  thing: Thing,
  pose: Pose,
): void {
  const reach = Math.max(reachOf(thing.shape), 5 / view.scale);
  const infrared = thing.kind === 'infrared';
  const colour = infrared ? colours.cone : fillOf(thing, colours);
  if (thing.on) {
    ctx.fillStyle = infrared ? colours.cone : colours.front;
    ctx.globalAlpha = 0.22;
    circle(ctx, pose, reach * 2.6);
    ctx.globalAlpha = 0.3;
    circle(ctx, pose, reach * 1.7);
    ctx.globalAlpha = 1;
    circle(ctx, pose, reach);
  }
  ctx.beginPath();
  ctx.arc(pose.x, pose.y, reach, 0, 2 * Math.PI);
  ctx.strokeStyle = thing.on ? colours.robotSide : colour;
  ctx.lineWidth = 1.5 / view.scale;
  ctx.stroke();
  if (!infrared) return;
  ctx.beginPath();
  for (const wave of [0.35, 0.7]) {
    ctx.moveTo(pose.x + reach * wave, pose.y);
    ctx.arc(pose.x, pose.y, reach * wave, 0, 2 * Math.PI);
  }
  ctx.stroke();
}

function drawTrails({ ctx, model, colours, view }: Scene): void {
  ctx.lineWidth = 2 / view.scale;
  ctx.lineJoin = 'round';
  ctx.strokeStyle = colours.trail;
  for (const { thing, pose } of model.standing()) {
    if (thing.kind !== 'robot') continue;
    const way = model.trails.of(thing.key);
    if (way.length === 0) continue;
    ctx.beginPath();
    way.forEach((point, index) =>
      index === 0 || point.begins ? ctx.moveTo(point.x, point.y) : ctx.lineTo(point.x, point.y),
    );
    const last = way.at(-1);
    if (last && Math.hypot(last.x - pose.x, last.y - pose.y) < 0.1) ctx.lineTo(pose.x, pose.y);
    ctx.stroke();
  }
}

function drawRays({ ctx, model, colours, view }: Scene): void {
  ctx.strokeStyle = colours.cone;
  ctx.fillStyle = colours.cone;
  ctx.lineWidth = 1.25 / view.scale;
  for (const look of model.looks()) {
    const { from, to } = look;
    // Carbot's one look is a sonar: what it hears is a cone.
    if (model.robotAt(look.robot)?.type === 'carbot') {
      const angle = Math.atan2(to.y - from.y, to.x - from.x);
      const reach = Math.hypot(to.x - from.x, to.y - from.y);
      ctx.globalAlpha = 0.28;
      ctx.beginPath();
      ctx.moveTo(from.x, from.y);
      ctx.arc(from.x, from.y, reach, angle - kConeHalf, angle + kConeHalf);
      ctx.fill();
      ctx.globalAlpha = 1;
    }
    ctx.globalAlpha = look.hit ? 0.95 : 0.4;
    ctx.beginPath();
    line(ctx, from, to);
    ctx.stroke();
    if (look.hit) circle(ctx, to, 2.5 / view.scale);
    ctx.globalAlpha = 1;
  }
}

/** A dark body with its paint on the roof, and a wedge that points ahead. */
function drawRobot({ ctx, colours, view }: Scene, thing: Thing, pose: Pose): void {
  const edge = Math.min(1.5 / view.scale, 0.012);
  ctx.beginPath();
  shapePath(ctx, thing, pose);
  ctx.fillStyle = colours.robot;
  ctx.fill();
  ctx.strokeStyle = colours.robotSide;
  ctx.lineWidth = edge;
  ctx.stroke();
  ctx.beginPath();
  shapePath(ctx, thing, pose, 0.7);
  ctx.fillStyle = css(thing.colour, 0.9);
  ctx.fill();
  const ahead = reachAhead(thing);
  const width = reachOf(thing.shape) * 0.4;
  const wedge = [
    { x: ahead * 0.94, y: 0 },
    { x: ahead * 0.28, y: width },
    { x: ahead * 0.28, y: -width },
  ].map((corner) => placed(corner, pose));
  ctx.beginPath();
  polygon(ctx, wedge);
  ctx.fillStyle = colours.front;
  ctx.fill();
  ctx.strokeStyle = colours.robotSide;
  ctx.lineWidth = edge * 0.8;
  ctx.stroke();
}

/** While the past is shown: where robots are now, dashed. */
function drawNow({ ctx, model, colours, view }: Scene): void {
  ctx.setLineDash([5 / view.scale, 4 / view.scale]);
  ctx.strokeStyle = colours.front;
  ctx.lineWidth = 1.5 / view.scale;
  for (const { thing, pose } of model.robotsNow()) {
    ctx.beginPath();
    shapePath(ctx, thing, pose);
    ctx.stroke();
  }
  ctx.setLineDash([]);
}

export function reachAhead(thing: Thing): number {
  return thing.shape.radius > 0
    ? thing.shape.radius
    : thing.shape.corners.reduce((most, corner) => Math.max(most, corner.x), 0.01);
}

function drawLamps({ ctx, model, view }: Scene): void {
  for (const lamp of litLamps(model)) {
    const radius = Math.max(lamp.radius, 2 / view.scale);
    ctx.fillStyle = css(lamp.colour, 0.35);
    circle(ctx, lamp.at, radius * 2.2);
    ctx.fillStyle = css(lamp.core);
    circle(ctx, lamp.at, radius);
  }
}

function drawPlacing({ ctx, model, colours, view }: Scene): void {
  const { placing } = model;
  if (!placing) return;
  ctx.beginPath();
  shapePath(ctx, shapeOfPlacing(placing), placing.at);
  ctx.globalAlpha = 0.4;
  ctx.fillStyle = colours.accent;
  ctx.fill();
  ctx.globalAlpha = 1;
  ctx.setLineDash([5 / view.scale, 3 / view.scale]);
  ctx.strokeStyle = colours.accent;
  ctx.lineWidth = 1.5 / view.scale;
  ctx.stroke();
  ctx.setLineDash([]);
}

// ---- on the screen: what is chosen, and how long a metre is ----

function drawMarks(scene: Scene): void {
  const { ctx, model, colours, view } = scene;
  const hovered = model.thing(model.hovered);
  if (hovered && hovered.key !== model.selected) outline(scene, hovered, 1.5, 0.55);
  const chosen = model.chosen;
  if (!chosen) return;
  const pose = model.poseOf(chosen);
  if (!Number.isFinite(pose.x)) return;
  outline(scene, chosen, 2, 1);
  if (!model.acts?.may) return;
  const middle = toScreen(view, model.screen, pose);
  const handle = toScreen(view, model.screen, handleOf(pose, reachOf(chosen.shape), view.scale));
  ctx.strokeStyle = colours.accent;
  ctx.lineWidth = 1.5;
  ctx.beginPath();
  line(ctx, middle, handle);
  ctx.stroke();
  ctx.fillStyle = colours.surface;
  ctx.beginPath();
  ctx.arc(handle.x, handle.y, kHandlePx, 0, 2 * Math.PI);
  ctx.fill();
  ctx.stroke();
  if (model.turning) label(scene, handle, `${shownDegrees(pose.angle).toFixed(0)}°`);
}

function outline(
  { ctx, model, colours, view }: Scene,
  thing: Thing,
  px: number,
  alpha: number,
): void {
  const pose = model.poseOf(thing);
  if (!Number.isFinite(pose.x)) return;
  const { screen } = model;
  ctx.globalAlpha = alpha;
  ctx.strokeStyle = colours.accent;
  ctx.lineWidth = px;
  ctx.beginPath();
  if (thing.shape.radius > 0) {
    const middle = toScreen(view, screen, pose);
    ctx.arc(middle.x, middle.y, thing.shape.radius * view.scale + 3, 0, 2 * Math.PI);
  } else {
    const away = 3 / view.scale;
    polygon(
      ctx,
      thing.shape.corners.map((corner) =>
        toScreen(
          view,
          screen,
          placed(
            {
              x: corner.x + Math.sign(corner.x) * away,
              y: corner.y + Math.sign(corner.y) * away,
            },
            pose,
          ),
        ),
      ),
    );
  }
  ctx.stroke();
  ctx.globalAlpha = 1;
}

function label({ ctx, colours }: Scene, at: Point, what: string): void {
  ctx.font = '11px "JetBrains Mono Variable", monospace';
  const width = ctx.measureText(what).width + 10;
  ctx.fillStyle = colours.surface;
  ctx.beginPath();
  ctx.roundRect(at.x + 10, at.y - 9, width, 18, 4);
  ctx.fill();
  ctx.fillStyle = colours.text;
  ctx.textBaseline = 'middle';
  ctx.fillText(what, at.x + 15, at.y + 0.5);
}

/** A bar of a round length, lower left, where there is room for it. */
function drawScale({ ctx, model, colours, view, options }: Scene): void {
  const { width, height } = model.screen;
  if (!options.grid || width < 220 || height < 150) return;
  const length = gridStep(view.scale, 48);
  const px = length * view.scale;
  const [x, y] = [12, height - 12];
  const words = lengthText(length);
  ctx.font = '500 11px "Inter Variable", sans-serif';
  ctx.globalAlpha = 0.86;
  ctx.fillStyle = colours.surface;
  ctx.beginPath();
  ctx.roundRect(x - 6, y - 20, Math.max(px, ctx.measureText(words).width) + 12, 26, 4);
  ctx.fill();
  ctx.globalAlpha = 1;
  ctx.strokeStyle = colours.text;
  ctx.lineWidth = 1.5;
  ctx.beginPath();
  ctx.moveTo(x, y - 4);
  ctx.lineTo(x, y);
  ctx.lineTo(x + px, y);
  ctx.lineTo(x + px, y - 4);
  ctx.stroke();
  ctx.fillStyle = colours.text;
  ctx.textBaseline = 'alphabetic';
  ctx.fillText(words, x, y - 7);
}

function shapePath(
  ctx: CanvasRenderingContext2D,
  { shape }: Pick<Thing, 'shape'>,
  pose: Pose,
  part = 1,
): void {
  if (shape.radius > 0) ctx.arc(pose.x, pose.y, shape.radius * part, 0, 2 * Math.PI);
  else
    polygon(
      ctx,
      shape.corners.map(({ x, y }) => placed({ x: x * part, y: y * part }, pose)),
    );
}

function polygon(ctx: CanvasRenderingContext2D, corners: readonly Point[]): void {
  corners.forEach(({ x, y }, index) => (index === 0 ? ctx.moveTo(x, y) : ctx.lineTo(x, y)));
  ctx.closePath();
}

function line(ctx: CanvasRenderingContext2D, from: Point, to: Point): void {
  ctx.moveTo(from.x, from.y);
  ctx.lineTo(to.x, to.y);
}

function circle(ctx: CanvasRenderingContext2D, at: Point, radius: number): void {
  ctx.beginPath();
  ctx.arc(at.x, at.y, radius, 0, 2 * Math.PI);
  ctx.fill();
}
