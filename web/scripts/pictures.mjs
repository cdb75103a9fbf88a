// Makes app/start/pictures.json: what is in the worlds of the examples, and the way that the
// robot takes, for the pictures of the start screen. Ways are in metres, drawn by hand.
import { readFileSync, writeFileSync } from 'node:fs';

const examples = {
  'follow-wall': [
    'follow-wall/hall',
    [
      [0.8, 1.9],
      [1.37, 0.7],
      [1.5, 0.52],
      [1.73, 0.45],
      [2.38, 0.48],
      [2.73, 0.55],
      [2.92, 0.69],
      [2.98, 0.97],
      [3.15, 1.26],
      [3.56, 1.31],
      [3.84, 1.25],
      [4.24, 0.94],
      [4.37, 0.77],
      [4.4, 0.55],
      [4.47, 0.43],
      [4.69, 0.4],
      [5.19, 0.4],
      [5.4, 0.43],
      [5.55, 0.55],
      [5.59, 0.8],
      [5.55, 1.96],
      [5.43, 2.13],
      [5.05, 2.3],
      [4.88, 2.48],
      [4.8, 2.79],
      [4.89, 3.05],
    ],
  ],
  'find-object': [
    'find-object/room',
    [
      [0.8, 0.8],
      [1.3, 1],
      [2.3, 2],
      [2.6, 2.9],
      [3.2, 3],
      [3.9, 2.3],
      [4.7, 1.25],
    ],
  ],
  rooms: [
    'rooms/flat',
    [
      [0.6, 3],
      [4.6, 3],
      [5.2, 3.2],
    ],
  ],
  obstacle: [
    'obstacle/carbot',
    [
      [1, 1.5],
      [1.75, 1.5],
      [1.6, 1.5],
      [1.6, 2.4],
      [2.7, 2.6],
      [3.6, 2.6],
      [3.95, 2.2],
    ],
  ],
  infrared: [
    'infrared/room',
    [
      [0.8, 0.8],
      [1.6, 1.6],
      [2.3, 2.45],
      [3.2, 3.2],
      [4.2, 3.35],
      [4.75, 3.1],
    ],
  ],
  thymio: [
    'thymio/arena',
    [
      [0.5, 0.2],
      [1.2, 0.2],
      [1.35, 0.3],
      [1.2, 0.75],
      [0.85, 0.85],
      [0.75, 0.6],
      [0.95, 0.3],
    ],
  ],
  patterns: [
    'patterns/carbot',
    [
      [1, 1],
      [2, 1],
      [2, 2],
      [1, 2],
      [1, 1],
    ],
  ],
  'follow-object': [
    'follow-object/hall',
    [
      [1, 1.5],
      [1.8, 1.6],
      [2.9, 1.7],
      [3.7, 2.2],
      [4, 3],
    ],
  ],
  'traffic-light': ['traffic-light/street', []],
  carbot: ['carbot/arena', []],
  epuck: [
    'epuck/colours',
    [
      [0.2, 0.2],
      [0.5, 0.5],
      [0.75, 0.6],
      [0.93, 0.6],
    ],
  ],
};

const pictures = {};
for (const [id, [file, way]] of Object.entries(examples)) {
  const world = JSON.parse(
    readFileSync(new URL(`../../examples/${file}.world.json`, import.meta.url), 'utf8'),
  );
  pictures[id] = {
    size: world.size,
    things: (world.objects ?? []).map(({ kind, at, size, radius, angle, colour }) => ({
      kind,
      at,
      size,
      radius,
      angle,
      colour,
    })),
    robots: (world.robots ?? []).map(({ type, at, angle }) => ({ type, at, angle })),
    way,
  };
}
writeFileSync(
  new URL('../app/start/pictures.json', import.meta.url),
  `${JSON.stringify(pictures)}\n`,
);
