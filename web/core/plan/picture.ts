// A plan as one SVG file: everything that the canvas draws, whole, whatever is in sight.

import { arrowId, isEvent, supervisorKey, type Drawing } from './arrows';
import { dataArrows } from './data';
import { kStart, type Actor, type Note, type PlanModel, type Supervisor } from './model';
import { roundedPath } from './path';
import {
  actorPart,
  kUiFonts,
  notePart,
  pillPart,
  portPart,
  startPart,
  supervisorPart,
  tagPart,
  type PictureLook,
  type Row,
} from './picture_parts';
import { blocksOf, type Scene } from './place';
import type { Port } from './route';
import { around, type Box } from './shape';
import { dataPath, gapPath, gapsOf, kEventDash, shortened } from './strokes';
import { escaped, tag } from './svg';

export interface Pictured {
  model: PlanModel;
  scene: Scene;
  drawing: Drawing;
  notes: readonly Note[];
  /** All data arrows, too. */
  data: boolean;
  /** What the start tag says. */
  start: string;
}

export interface Picture {
  svg: string;
  width: number;
  height: number;
}

const kMargin = 24;

export function pictureOf(plan: Pictured, look: PictureLook): Picture {
  const { x, y, width, height } = frameOf(plan);
  const parts = [
    tag('title', {}, escaped(plan.model.name)),
    heads(look),
    tag('rect', { x, y, width, height, fill: look.canvas }),
    ...plan.notes.map((note) => notePart(note, look)),
    ...(plan.data ? dataLines(plan, look) : []),
    ...arrowLines(plan, look),
    ...elements(plan, look),
  ];
  const svg = tag(
    'svg',
    {
      xmlns: 'http://www.w3.org/2000/svg',
      width,
      height,
      viewBox: `${x} ${y} ${width} ${height}`,
      'font-family': kUiFonts,
    },
    ...parts.map((part) => `\n${part}`),
    '\n',
  );
  return { svg: `<?xml version="1.0" encoding="UTF-8"?>\n${svg}\n`, width, height };
}

function frameOf({ scene, drawing, notes }: Pictured): Box {
  const points = [...drawing.routes.values()].flatMap((route) => route.points);
  const whole = around([
    ...blocksOf(scene).map((block) => block.whole),
    ...scene.pills.map(({ box }) => box),
    ...drawing.tags.map(({ box }) => box),
    ...notes.map(({ at: [x, y], size: [width, height] }) => ({ x, y, width, height })),
    ...points.map((point) => ({ ...point, width: 0, height: 0 })),
  ]);
  const x = Math.floor(whole.x - kMargin);
  const y = Math.floor(whole.y - kMargin);
  const width = Math.ceil(whole.x + whole.width + kMargin) - x;
  return { x, y, width, height: Math.ceil(whole.y + whole.height + kMargin) - y };
}

function heads(look: PictureLook): string {
  const head = tag('path', { d: 'M0 0L10 4.5L0 9z', fill: look.arrow });
  const measures = { refX: 1, refY: 4.5, markerWidth: 11, markerHeight: 10 };
  const how = { viewBox: '0 0 10 9', markerUnits: 'userSpaceOnUse', orient: 'auto' };
  return tag('defs', {}, tag('marker', { id: 'head', ...how, ...measures }, head));
}

function arrowLines({ drawing }: Pictured, look: PictureLook): string[] {
  const gaps = gapsOf(drawing);
  const pen = { fill: 'none', stroke: look.arrow, 'stroke-width': 3, 'stroke-linejoin': 'round' };
  return drawing.arrows.flatMap(({ id, source, outcome, target }) => {
    const route = drawing.routes.get(id);
    if (!route) return [];
    const line = tag('path', {
      d: roundedPath(shortened(route)),
      ...pen,
      ...(isEvent(source) && { 'stroke-dasharray': kEventDash }),
      'marker-end': 'url(#head)',
    });
    const around = (gaps.get(id) ?? []).map((gap) =>
      tag('path', { d: gapPath(gap), fill: 'none', stroke: look.canvas, 'stroke-width': 11 }),
    );
    const title = tag('title', {}, escaped(`${source} ${outcome}: ${target}`));
    return tag('g', {}, title, ...around, line);
  });
}

function dataLines({ model, scene }: Pictured, look: PictureLook): string[] {
  const pills = new Map(scene.pills.map(({ name, box }) => [name, box]));
  const pen = { fill: 'none', stroke: look.data };
  const linesOf = (element: Actor | Supervisor, box: Box) =>
    dataArrows(model, element).flatMap((arrow, index) => {
      const pill = pills.get(arrow.variable);
      if (!pill) return [];
      const { line, head } = dataPath(arrow, box, pill, index);
      return tag('path', { d: line, ...pen }) + tag('path', { d: head, ...pen });
    });
  return blocksOf(scene).flatMap((block) => [
    ...model.actors
      .filter((actor) => actor.name === block.name)
      .flatMap((actor) => linesOf(actor, block.box)),
    ...block.supervisors.flatMap(({ supervisor, box }) => linesOf(supervisor, box)),
  ]);
}

function elements(plan: Pictured, look: PictureLook): string[] {
  const { model, scene, drawing } = plan;
  const rows = rowsBySource(drawing);
  const rowsOf = (key: string) => rows.get(key) ?? [];
  const hanging = blocksOf(scene).flatMap((block) => block.supervisors);
  const boxOf = new Map(scene.actors.map(({ name, box }) => [name, box]));
  const start = rowsOf(kStart)[0];
  return [
    startPart(scene.start.box, plan.start, look),
    start ? portPart(start.port.x, start.port.y, start.isLoose, look) : '',
    ...model.actors.flatMap((actor) => {
      const box = boxOf.get(actor.name);
      return box ? actorPart(actor, box, rowsOf(actor.name), look) : [];
    }),
    ...hanging.map(({ supervisor, box }) =>
      supervisorPart(supervisor, box, rowsOf(supervisorKey(supervisor)), look),
    ),
    ...scene.pills.flatMap(({ name, box }) => {
      const variable = model.variables.find((one) => one.name === name);
      return variable ? pillPart(variable, box, look) : [];
    }),
    ...drawing.tags.map(({ box, is }) => tagPart(box, is, look)),
  ];
}

function rowsBySource({ arrows, loose }: Drawing): Map<string, Row[]> {
  const rows = new Map<string, Row[]>();
  const seen = new Set<string>();
  const add = (isLoose: boolean) => (one: { source: string; outcome: string; port: Port }) => {
    const id = arrowId(one.source, one.outcome);
    if (seen.has(id)) return;
    seen.add(id);
    const row = { name: one.outcome, port: one.port, isLoose };
    rows.set(one.source, [...(rows.get(one.source) ?? []), row]);
  };
  arrows.forEach(add(false));
  loose.forEach(add(true));
  return rows;
}
