// The elements of a plan as SVG, drawn as the canvas draws them: shapes by role, names, rows.

import type { Actor, Note, Supervisor, Variable } from './model';
import type { Port } from './route';
import type { Box } from './shape';
import { escaped, tag, type Attributes } from './svg';

export interface PictureLook {
  canvas: string;
  raised: string;
  panel: string;
  bar: string;
  border: string;
  borderStrong: string;
  text: string;
  secondary: string;
  muted: string;
  arrow: string;
  data: string;
  error: string;
}

/** A state or event, where its arrow starts. */
export interface Row {
  name: string;
  port: Port;
  isLoose: boolean;
}

export const kUiFonts = "'Inter Variable', Inter, system-ui, 'Segoe UI', sans-serif";
const kCodeFonts = "'JetBrains Mono Variable', 'JetBrains Mono', ui-monospace, monospace";

interface Written extends Attributes {
  x: number;
  y: number;
  fill: string;
  'font-size': number;
}

/** A letter is about so wide, in parts of its size. */
const kLetter = 0.57;

/** One line; what is too long for its room is set closer, never cut. */
function written(text: string, room: number, at: Written): string {
  const isWide = [...text].length * at['font-size'] * kLetter > room;
  const close = isWide ? { textLength: room, lengthAdjust: 'spacingAndGlyphs' } : {};
  return tag('text', { ...at, ...close }, escaped(text));
}

const strong = { 'font-weight': 600 };

export function startPart({ x, y, width, height }: Box, word: string, look: PictureLook): string {
  return (
    tag('rect', { x, y, width, height, rx: height / 2, fill: look.secondary }) +
    written(word, width - 24, {
      x: x + width / 2,
      y: y + height / 2 + 4,
      fill: look.canvas,
      'font-size': 12,
      'text-anchor': 'middle',
      ...strong,
    })
  );
}

export function actorPart(actor: Actor, box: Box, rows: readonly Row[], look: PictureLook): string {
  const { x, y, width } = box;
  const head =
    iconPart(actor, x + 10, y + 13, look) +
    written(actor.name, width - 48, {
      x: x + 38,
      y: y + 20,
      fill: look.text,
      'font-size': 13,
      ...strong,
    }) +
    written(actor.template, width - 48, {
      x: x + 38,
      y: y + 35,
      fill: look.muted,
      'font-size': 11,
    });
  return tag('g', {}, actorShape(actor, box, look), head, ...rows.map((row) => rowPart(row, look)));
}

const kCut = 14;

function actorShape(actor: Actor, { x, y, width, height }: Box, look: PictureLook): string {
  const fill = { fill: look.raised, stroke: look.borderStrong };
  if (actor.role === 'computation') {
    const cut = `M${x} ${y}h${width - kCut}l${kCut} ${kCut}v${height - kCut}h${-width}z`;
    return tag('path', { d: cut, ...fill });
  }
  const inner = tag('rect', { x, y, width, height, rx: 8, ...fill });
  if (actor.role === 'actor') return inner;
  const outer = { x: x - 3, y: y - 3, width: width + 6, height: height + 6, rx: 10 };
  return tag('rect', { ...outer, fill: 'none', stroke: look.borderStrong }) + inner;
}

const kSubPlanIcon = 'M3 4h18v16H3zM7 8h10v8H7z';

function iconPart(actor: Actor, x: number, y: number, look: PictureLook): string {
  const d = actor.role === 'subplan' ? kSubPlanIcon : (actor.known?.icon ?? '');
  if (d === '') return '';
  const transform = `translate(${x} ${y}) scale(0.75)`;
  const pen = { fill: 'none', stroke: look.secondary, 'stroke-width': 1.75 };
  return tag('path', { d, transform, ...pen, 'stroke-linecap': 'round' });
}

function rowPart({ name, port, isLoose }: Row, look: PictureLook): string {
  const isLeft = port.side === 'left';
  const colour = isLoose ? look.error : look.secondary;
  return (
    written(name, 148, {
      x: port.x + (isLeft ? 10 : -10),
      y: port.y + 4,
      fill: colour,
      'font-size': 11,
      'text-anchor': isLeft ? 'start' : 'end',
    }) + portPart(port.x, port.y, isLoose, look)
  );
}

export function portPart(x: number, y: number, isLoose: boolean, look: PictureLook): string {
  const pen = isLoose
    ? { fill: look.raised, stroke: look.error }
    : { fill: look.arrow, stroke: look.raised };
  return tag('circle', { cx: x, cy: y, r: 4, ...pen });
}

const kTip = 9;

export function supervisorPart(
  supervisor: Supervisor,
  { x, y, width, height }: Box,
  rows: readonly Row[],
  look: PictureLook,
): string {
  const level = width - 2 * kTip;
  const half = height / 2;
  const d = `M${x + kTip} ${y}h${level}l${kTip} ${half}l${-kTip} ${half}h${-level}l${-kTip} ${-half}z`;
  const only = rows.length === 1;
  return tag(
    'g',
    {},
    tag('path', { d, fill: look.raised, stroke: look.border }),
    written(supervisor.name, width - 39, {
      x: x + 29,
      y: y + 16,
      fill: look.text,
      'font-size': 11,
      ...strong,
    }),
    ...rows.map(
      ({ name, port, isLoose }) =>
        written(name, width - 39, {
          x: x + 29,
          y: port.y + (only ? 11 : 4),
          fill: isLoose ? look.error : look.secondary,
          'font-size': 11,
        }) + portPart(port.x, port.y, isLoose, look),
    ),
  );
}

export function pillPart(variable: Variable, box: Box, look: PictureLook): string {
  const { x, y, width, height } = box;
  const value = `${variable.initial} ${variable.unit}`.trim();
  const base = y + height / 2 + 4;
  return tag(
    'g',
    {},
    tag('rect', {
      ...{ x, y, width, height, rx: height / 2 },
      ...{ fill: look.panel, stroke: look.borderStrong },
    }),
    written(variable.name, value === '' ? width - 24 : width * 0.55, {
      x: x + 12,
      y: base,
      fill: look.text,
      'font-size': 11,
      'font-family': kCodeFonts,
    }),
    written(value, width * 0.35, {
      x: x + width - 12,
      y: base,
      fill: look.secondary,
      'font-size': 11,
      'text-anchor': 'end',
    }),
  );
}

export function tagPart(box: Box, is: 'terminate' | 'ignore', look: PictureLook): string {
  const x = box.x + box.width / 2;
  const y = box.y + box.height / 2;
  const sign =
    is === 'terminate'
      ? tag('rect', { x: x - 4, y: y - 4, width: 8, height: 8, rx: 1, fill: look.secondary })
      : tag('path', { d: `M${x - 4} ${y}h8`, stroke: look.secondary, 'stroke-width': 2 });
  const ring = { fill: look.raised, stroke: look.secondary, 'stroke-width': 2 };
  return tag('circle', { cx: x, cy: y, r: box.width / 2 - 1, ...ring }) + sign;
}

const kNoteLine = 16;

export function notePart(note: Note, look: PictureLook): string {
  const [x, y] = note.at;
  const [width, height] = note.size;
  const most = Math.max(1, Math.floor((width - 18) / (12 * kLetter)));
  const room = Math.max(1, Math.floor((height - 12) / kNoteLine));
  const lines = note.text.split('\n').flatMap((line) => wrapped(line, most));
  const frame = { fill: look.bar, stroke: look.borderStrong, 'stroke-dasharray': '4 3' };
  return tag(
    'g',
    {},
    tag('title', {}, escaped(note.text)),
    tag('rect', { x, y, width, height, rx: 4, ...frame }),
    ...lines.slice(0, room).map((line, index) =>
      written(line, width - 18, {
        x: x + 9,
        y: y + 19 + index * kNoteLine,
        fill: look.secondary,
        'font-size': 12,
      }),
    ),
  );
}

/** Lines of at most so many letters, broken between words where that is possible. */
export function wrapped(text: string, most: number): string[] {
  const lines: string[] = [];
  let rest = text;
  while (rest.length > most) {
    const space = rest.lastIndexOf(' ', most);
    const end = space > 0 ? space : most;
    lines.push(rest.slice(0, end));
    rest = rest.slice(space > 0 ? end + 1 : end);
  }
  return [...lines, rest];
}
