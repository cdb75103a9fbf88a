import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import type { Json } from '../../protocol/messages';
import { drawingOf } from './arrows';
import { planModel } from './model';
import { pictureOf } from './picture';
import { wrapped, type PictureLook } from './picture_parts';
import { sceneOf } from './place';

const look: PictureLook = {
  canvas: '#ffffff',
  raised: '#fefefe',
  panel: '#fdfdfd',
  bar: '#fcfcfc',
  border: '#888888',
  borderStrong: '#999999',
  text: '#111111',
  secondary: '#222222',
  muted: '#333333',
  arrow: '#444444',
  data: '#555555',
  error: '#aa0000',
};

function picture(file: Json, data = false) {
  const model = planModel(file, []);
  const scene = sceneOf(model);
  const drawing = drawingOf(model, scene);
  return pictureOf({ model, scene, drawing, notes: model.notes, data, start: 'Start' }, look);
}

/** What a parser of XML sees: for each element its name, its attributes and its text. */
function parsed(svg: string): [string, Record<string, string>, string][] {
  const script =
    'import json,sys,xml.etree.ElementTree as E\n' +
    'print(json.dumps([[e.tag.split("}")[1],e.attrib,e.text or ""] for e in E.fromstring(sys.stdin.buffer.read()).iter()]))';
  const said = execFileSync('python3', ['-c', script], { input: svg, encoding: 'utf8' });
  return JSON.parse(said) as [string, Record<string, string>, string][];
}
const texts = (svg: string) =>
  parsed(svg).flatMap(([name, , text]) => (name === 'text' ? text : []));

const kRoot = new URL('../../../', import.meta.url).pathname;
const wallFollow = JSON.parse(
  readFileSync(`${kRoot}examples/follow-wall/WallFollow.plan.json`, 'utf8'),
) as Json;

test('every actor, supervisor and variable is in the picture', () => {
  const { svg } = picture(wallFollow);
  const model = planModel(wallFollow, []);
  const shown = texts(svg);
  expect(shown).toContain('Start');
  for (const { name } of model.actors) expect(shown).toContain(name);
  for (const { name } of model.globals) expect(shown).toContain(name);
  for (const { name } of model.variables) expect(shown).toContain(name);
});

const small: Json = {
  name: 'A <plan> & more',
  start: { actor: 'a' },
  configuration: { v: { type: 'float', initial: 2, unit: '"' } },
  actors: {
    a: { template: 'T', in: { x: 'v' }, states: { 'Done & <over>\u0001': 'b' } },
    b: { template: 'T', states: { Done: '@terminate' } },
  },
  layout: { '@start': [0, 0], a: [0, 100], b: [400, 100], '@configuration': [200, 0] },
  x: { notes: [{ at: [0, 300], size: [100, 60], text: 'x < y\n"why"' }] },
};

test('names of any letters give valid XML', () => {
  const shown = texts(picture(small).svg);
  expect(shown).toContain('Done & <over>?');
  expect(shown).toContain('2 "');
  expect(shown).toContain('x < y');
});

test('the frame holds everything with a margin of 24', () => {
  const { svg, width, height } = picture(small);
  // b ends at 400 + 168, its tag 22 behind that with 22 of its own; the note ends at 360.
  expect(width).toBe(24 + 400 + 168 + 22 + 22 + 24);
  expect(height).toBe(24 + 360 + 24);
  expect(parsed(svg)[0]?.[1]).toMatchObject({
    width: String(width),
    viewBox: `-24 -24 ${width} ${height}`,
  });
});

test('arrows have a head each; data arrows are there if they are asked for', () => {
  const heads = (svg: string) => parsed(svg).filter(([, all]) => all['marker-end']).length;
  const thin = (svg: string) => parsed(svg).filter(([, all]) => all['stroke'] === look.data).length;
  // Start to a, a to b, b to terminate.
  expect(heads(picture(small).svg)).toBe(3);
  expect(thin(picture(small).svg)).toBe(0);
  // A line and a head.
  expect(thin(picture(small, true).svg)).toBe(2);
});

test('arrows of events are dashed, those of states are not', () => {
  const file = {
    format: 'vagus-plan/1',
    start: { actor: 'a', supervisors: { w: { template: 'W', events: { True: 'b' } } } },
    actors: {
      a: { template: 'T', states: { Done: 'b' } },
      b: { template: 'T', states: { Done: '@terminate' } },
    },
    layout: { '@start': [0, 0], a: [0, 100], b: [400, 100] },
  };
  const lines = parsed(picture(file).svg).filter(([, all]) => all['marker-end']);
  // Start to a, a to b, b to terminate; and the event of w.
  expect(lines.map(([, all]) => all['stroke-dasharray'] ?? 'whole').sort()).toEqual([
    '9 5',
    'whole',
    'whole',
    'whole',
  ]);
});

test('a note is broken between words, a long word where it must be', () => {
  expect(wrapped('the lamp is slow', 8)).toEqual(['the lamp', 'is slow']);
  expect(wrapped('abcdefgh', 3)).toEqual(['abc', 'def', 'gh']);
  expect(wrapped('', 8)).toEqual(['']);
});
