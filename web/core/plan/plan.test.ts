import { readdirSync, readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import type { Json } from '../../protocol/messages';
import { drawingOf, goOn, type Drawing } from './arrows';
import { dataArrows, namesIn } from './data';
import { planModel, supervisorsOf } from './model';
import { crossings, eachStretch, roundedPath } from './path';
import { dropPlace, freePlace, freePlaceIn, sceneOf, type Scene } from './place';
import { seeded } from '../test_seeded';
import { kApart } from './route';
import type { Point } from './shape';
import {
  covered,
  coveredNotes,
  faultsOfArrows,
  packedPlan,
  randomPlan,
  toolboxes,
} from './test_plans';
import { findTemplate, hiddenBy, matching } from './templates';

function files(): { name: string; value: Json }[] {
  const root = new URL('../../../', import.meta.url).pathname;
  const all = [`${root}testdata/golden/plans`, ...folders(`${root}examples`)].flatMap((folder) =>
    readdirSync(folder)
      .filter((name) => name.endsWith('.plan.json'))
      .map((name) => `${folder}/${name}`),
  );
  return all.flatMap((path) => {
    try {
      return [
        { name: path.slice(root.length), value: JSON.parse(readFileSync(path, 'utf8')) as Json },
      ];
    } catch {
      // Some golden plans are no JSON: what the checker says of them is tested elsewhere.
      return [];
    }
  });
}

function folders(root: string): string[] {
  return readdirSync(root, { withFileTypes: true })
    .filter((one) => one.isDirectory())
    .map((one) => `${root}/${one.name}`);
}

const small: Json = {
  format: 'vagus-plan/1',
  name: 'P',
  toolboxes: ['drive'],
  configuration: { far: { type: 'float', initial: 3, unit: 'cm' }, count: { type: 'int' } },
  start: {
    actor: 'go',
    supervisors: { end: { template: 'Timeout', events: { Timeout: '@terminate' } } },
  },
  actors: {
    go: {
      template: 'Forward',
      in: { distance: "far * 2 & ' count '" },
      out: { end: 'count' },
      states: { There: 'count', Lost: 'rest' },
      supervisors: { look: { template: 'Watch', events: { True: 'nowhere' } } },
    },
    count: { template: 'For', states: { Loop: 'go' } },
    sub: { plan: 'q.plan.json', states: { OK: '@terminate' } },
  },
  layout: { go: [80, 160], gone: [1, 2] },
};

describe('the model of a plan', () => {
  const model = planModel(small, toolboxes);

  it('knows roles, states that are declared first, and where they lead', () => {
    expect(model.actors.map(({ name, role }) => [name, role])).toEqual([
      ['go', 'actor'],
      ['count', 'computation'],
      ['sub', 'subplan'],
    ]);
    const led = model.actors.map(({ outcomes }) => outcomes.map((one) => [one.name, one.target]));
    expect(led).toEqual([
      [
        ['There', 'count'],
        ['Lost', 'rest'],
      ],
      [
        ['Loop', 'go'],
        ['Done', null],
      ],
      [
        ['OK', '@terminate'],
        ['Interrupted', null],
        ['Error', null],
      ],
    ]);
    expect(supervisorsOf(model).map(({ owner, name, keys }) => [owner, name, keys])).toEqual([
      ['@start', 'end', ['start', 'supervisors', 'end']],
      ['go', 'look', ['actors', 'go', 'supervisors', 'look']],
    ]);
  });

  it('finds variables in formulas, not in texts and functions', () => {
    expect([...namesIn(`min(a, b2) + "c" & 'd' + 1e3 + _e`)]).toEqual(['a', 'b2', '_e']);
    const go = model.actors[0];
    expect(go && dataArrows(model, go)).toEqual([
      { variable: 'far', element: 'go', port: 'distance', is: 'in' },
      { variable: 'count', element: 'go', port: 'end', is: 'out' },
    ]);
  });

  it('looks for templates in core first, then in what the plan lists', () => {
    expect(findTemplate(toolboxes, [], 'Forward', false)).toBeUndefined();
    expect(findTemplate(toolboxes, ['drive'], 'Forward', false)?.toolbox).toBe('drive');
    expect(findTemplate(toolboxes, ['drive'], 'Timeout', false)).toBeUndefined();
  });

  it('are hidden by those of the same name in a toolbox that is listed before', () => {
    const template = findTemplate(toolboxes, ['drive'], 'Forward', false)?.template;
    expect(template).toBeDefined();
    if (!template) return;
    const ours = { name: 'ours', help: '', templates: [template] };
    const both = [...toolboxes, ours];
    const of = (toolbox: string) => ({ toolbox, template });
    expect(hiddenBy(both, [], of('ours'))).toBeNull();
    expect(hiddenBy(both, ['drive'], of('ours'))).toBe('drive');
    expect(hiddenBy(both, ['drive', 'ours'], of('ours'))).toBe('drive');
    expect(hiddenBy(both, ['ours', 'drive'], of('ours'))).toBeNull();
    expect(hiddenBy(both, ['ours'], of('drive'))).toBe('ours');
    const found = matching(toolboxes, 'drive for');
    expect(found.map((one) => one.templates.map(({ name }) => name))).toEqual([['Forward']]);
  });
});

describe('places', () => {
  const model = planModel(small, toolboxes);
  const scene = sceneOf(model);

  it('are those of the file, else where nothing is', () => {
    const go = scene.actors[0];
    // Head 44, two states of 22, foot 4; below it, after 4, the supervisor of 40.
    expect(go?.box).toEqual({ x: 80, y: 160, width: 168, height: 92 });
    expect(go?.supervisors[0]?.box).toEqual({ x: 88, y: 256, width: 152, height: 40 });
    // Above the first actor, with 48 between: the tag of 30 and its supervisor of 4 + 40.
    expect(scene.start.box).toEqual({ x: 80, y: 38, width: 84, height: 30 });
    expectApart(scene);
  });

  it('of what is added are free', () => {
    // Below the block that ends at 296, and the sub-plan from 344 to 458; 506 is no multiple of 8.
    expect(freePlace(scene, { x: 83, y: 165 })).toEqual({ x: 80, y: 504 });
    expect(freePlace(scene, { x: 1003, y: 5 })).toEqual({ x: 1000, y: 8 });
  });

  it('of what is dropped are where it was dropped, or next to that', () => {
    const room = { x: 0, y: 0, width: 700, height: 400 };
    expect(dropPlace(room, scene, { x: 403, y: 165 })).toEqual({ x: 400, y: 168 });
    // Over the block from 80 to 248: 24 behind it is 272, and the next of every 24 is 288.
    expect(dropPlace(room, scene, { x: 200, y: 168 })).toEqual({ x: 288, y: 168 });
  });

  it('of what is added are in sight where there is room', () => {
    // Below the blocks it would end at 504 + 92: the column to the right is next, 168 + 48 further.
    const room = { x: 0, y: 0, width: 700, height: 400 };
    expect(freePlaceIn(room, scene, { x: 83, y: 165 })).toEqual({ x: 296, y: 168 });
    // Nothing below the point is in sight: the nearest of every 24. Left of 272, which is 24 behind what ends at 248,
    // blocks are in the way; 92 and 24 above 344, where the sub-plan begins, is 228.
    expect(freePlaceIn(room, scene, { x: 83, y: 350 })).toEqual({ x: 288, y: 216 });
    // Nowhere in sight: as without it.
    const small = { x: 0, y: 0, width: 100, height: 100 };
    expect(freePlaceIn(small, scene, { x: 83, y: 165 })).toEqual({ x: 80, y: 504 });
  });
});

describe('ways', () => {
  it('have rounded corners, smaller where there is no room', () => {
    const points = [
      { x: 0, y: 0 },
      { x: 20, y: 0 },
      { x: 20, y: 8 },
      { x: 60, y: 8 },
    ];
    expect(roundedPath(points)).toBe('M0 0L16 0Q20 0 20 4L20 4Q20 8 24 8L60 8');
  });

  it('cross where both go on', () => {
    const level = { id: 'a', points: [at(0, 10), at(100, 10)] };
    const upright = { id: 'b', points: [at(50, 0), at(50, 90)] };
    const found = crossings([level, upright], (id) => id);
    expect(found).toEqual(new Map([['b', [{ x: 50, y: 10, isLevel: false }]]]));
    expect(crossings([level, upright], () => 'one').size).toBe(0);
  });

  it('lead from rows to tags beside them, and nowhere without a target', () => {
    const model = planModel(small, toolboxes);
    const drawing = drawingOf(model, sceneOf(model));
    expect(drawing.tags.map(({ id, is }) => [id, is])).toEqual([
      ['@start/end.Timeout', 'terminate'],
      ['sub.OK', 'terminate'],
    ]);
    expect(drawing.loose.map(({ id }) => id)).toEqual([
      'go.Lost',
      'go/look.True',
      'count.Done',
      'sub.Interrupted',
      'sub.Error',
    ]);
    expect(drawing.arrows.map(({ id, target }) => `${id} ${target}`)).toEqual([
      '@start. go',
      'go.There count',
      'count.Loop go',
      '@start/end.Timeout @terminate',
      'sub.OK @terminate',
    ]);
  });

  it('of all sample and golden plans go round boxes and keep apart', () => {
    const all = files();
    expect(all.length).toBeGreaterThan(60);
    for (const { name, value } of all) {
      const model = planModel(value, toolboxes);
      const scene = sceneOf(model);
      expectDrawn(name, scene, drawingOf(model, scene));
    }
  }, 60_000);

  it('of 100 random plans go round boxes, whether they are placed by hand or not', () => {
    const seed = Number(process.env['VAGUS_SEED'] ?? Math.floor(Math.random() * 2 ** 31));
    console.info(`seed ${seed}`);
    const random = seeded(seed);
    for (let plan = 0; plan < 100; plan++) {
      const value = randomPlan(random);
      const model = planModel(value, toolboxes);
      const scene = sceneOf(model);
      expectApart(scene);
      expectRound(`seed ${seed}, plan ${plan}`, scene, drawingOf(model, scene));
    }
  }, 300_000);

  it('of 50 random plans go between boxes that stand close together, and round notes', () => {
    const seed = Number(process.env['VAGUS_SEED'] ?? Math.floor(Math.random() * 2 ** 31));
    console.info(`seed ${seed}`);
    const random = seeded(seed);
    for (let plan = 0; plan < 50; plan++) {
      const model = planModel(packedPlan(random), toolboxes);
      const scene = sceneOf(model);
      expectApart(scene);
      const name = `seed ${seed}, plan ${plan}`;
      expect(coveredNotes(model, scene), name).toEqual([]);
      expect(faultsOfArrows(scene, drawingOf(model, scene), model.notes), name).toEqual([]);
    }
  }, 300_000);

  it('run through a note on which elements stand', () => {
    const noted = (at: number[], size: number[]) => ({
      ...small,
      x: { notes: [{ at, size, text: '' }] },
    });
    const routeOf = (value: Json) => {
      const model = planModel(value, toolboxes);
      return drawingOf(model, sceneOf(model)).routes.get('go.There')?.points;
    };
    expect(routeOf(noted([-2000, -2000], [4000, 4000]))).toEqual(routeOf(small));
  });

  it('are kept while something else moves, and found bit by bit', () => {
    const model = planModel(small, toolboxes);
    const scene = sceneOf(model);
    const whole = drawingOf(model, scene);
    expect(whole.isSketch).toBe(false);
    // No time but for one: the others as they were, straight where there were none.
    const sketch = drawingOf(model, scene, { isTime: () => true });
    expect(sketch.isSketch).toBe(true);
    expect([...sketch.routes.keys()].sort()).toEqual([...whole.routes.keys()].sort());
    expect(goOn(sketch).routes.get('go.There')).toEqual(whole.routes.get('go.There'));
    const before = drawingOf(model, scene, { isTime: () => true, before: whole });
    expect(before.routes.get('go.There')).toEqual(whole.routes.get('go.There'));
    const kept = drawingOf(model, scene, { before: whole, keeps: true });
    expect(kept.routes.get('go.There')?.points).toBe(whole.routes.get('go.There')?.points);
  });
});

const at = (x: number, y: number): Point => ({ x, y });

function expectApart(scene: Scene): void {
  expect(covered(scene)).toEqual([]);
}

function expectRound(name: string, scene: Scene, drawing: Drawing) {
  const routes = drawing.arrows.map((arrow) => ({
    aim: arrow.target.startsWith('@') ? arrow.id : arrow.target,
    id: arrow.id,
    points: drawing.routes.get(arrow.id)?.points ?? [],
  }));
  expect(new Set(routes.map(({ id }) => id)).size, name).toBe(routes.length);
  expect(faultsOfArrows(scene, drawing), name).toEqual([]);
  return routes;
}

/** Every arrow is there, has right angles, runs through no box, and beside no other one's. */
function expectDrawn(name: string, scene: Scene, drawing: Drawing): void {
  const routes = expectRound(name, scene, drawing);
  routes.forEach((one, index) => {
    for (const other of routes.slice(index + 1))
      if (one.aim !== other.aim)
        expect(besides(one.points, other.points), `${name} ${one.id} ${other.id}`).toBe(false);
  });
}

/** Two stretches run side by side, nearer than they may. */
function besides(a: readonly Point[], b: readonly Point[]): boolean {
  let found = false;
  eachStretch(a, (p, q) =>
    eachStretch(b, (r, s) => {
      const level = p.y === q.y;
      if (level !== (r.y === s.y)) return;
      const apart = level ? Math.abs(p.y - r.y) : Math.abs(p.x - r.x);
      const [a1, a2, b1, b2] = level ? [p.x, q.x, r.x, s.x] : [p.y, q.y, r.y, s.y];
      const both =
        Math.min(Math.max(a1, a2), Math.max(b1, b2)) - Math.max(Math.min(a1, a2), Math.min(b1, b2));
      if (apart < kApart && both > 0) found = true;
    }),
  );
  return found;
}
