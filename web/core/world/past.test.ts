// The world of an instant: where things were, beside where they are.
import { describe, expect, test } from 'vitest';
import type { Topics } from '../../protocol/messages';
import { posesThen } from './frames';
import { dashesAround, disc, rectangle } from './geometry';
import { WorldModel } from './model';
import { stageOfScene } from './stage';

const scene = {
  name: 'x',
  size: [3, 3],
  open: false,
  ground: [1, 1, 1],
  robots: [
    {
      name: 'a',
      type: 'epuck',
      nodes: [1],
      outline: [],
      paint: [1, 0, 0],
      height: 0.05,
      camera: false,
      buttons: [],
    },
  ],
  objects: [
    {
      id: 'box',
      number: 4,
      kind: 'box',
      height: 0.1,
      mass: 1,
      colour: [1, 1, 1],
      on: true,
      size: [1, 1],
    },
  ],
} as unknown as Topics['scene']['is'];

const pose = (x: number) => ({ x, y: 1, angle: 0 });

describe('the world of an instant', () => {
  test('ThingsStandWhereTheyStoodAndRobotsOfNowAreRemembered', () => {
    const model = new WorldModel();
    model.setStage(stageOfScene(scene));
    model.setPoses(5, { robots: [pose(2)], objects: [{ number: 4, pose: pose(2.5) }] });
    expect(model.robotsNow()).toEqual([]);
    model.showThen(posesThen({ robots: [[0, 1, 1, 0]], objects: [[4, 1.5, 1, 0]] }));
    const places = () => model.stage.things.map((thing) => model.poseOf(thing).x);
    expect(places()).toEqual([1.5, 1]);
    // What goes on meanwhile is where robots are now, and is not shown as if it were then.
    model.setPoses(6, { robots: [pose(2.2)], objects: [] });
    expect(places()).toEqual([1.5, 1]);
    expect(model.robotsNow().map((one) => one.pose.x)).toEqual([2.2]);
    model.showThen(null);
    expect(places()).toEqual([2.5, 2.2]);
    expect(model.robotsNow()).toEqual([]);
  });

  test('SensorsLookFromWhereTheirRobotWas', () => {
    const model = new WorldModel();
    model.setStage(stageOfScene(scene));
    model.setPoses(5, { robots: [pose(2)], objects: [] });
    const look = { robot: 0, hit: true, from: { x: 0.1, y: 0 }, to: { x: 0.5, y: 0.2 } };
    model.setRays({ looks: [look, { ...look, robot: 1 }], lamps: [] });
    // A robot that is not in the scene looks nowhere.
    expect(model.looks()).toEqual([{ ...look, from: { x: 2.1, y: 1 }, to: { x: 2.5, y: 1.2 } }]);
    model.showThen(posesThen({ robots: [[0, 1, 1, Math.PI / 2]], objects: [] }));
    const [then] = model.looks();
    // It looked to the left of where it looks now: ahead is up.
    expect(then?.from.x).toBeCloseTo(1);
    expect(then?.from.y).toBeCloseTo(1.1);
    expect(then?.to.x).toBeCloseTo(0.8);
    expect(then?.to.y).toBeCloseTo(1.5);
  });

  test('WhatIsNoPoseIsNowhere', () => {
    const { robots, objects } = posesThen({ robots: [[0, null, 1]], objects: ['x'] });
    expect(robots[0]?.x).toBeNaN();
    expect(robots[0]?.y).toBe(1);
    expect(objects[0]?.pose.x).toBeNaN();
  });

  test('AnEdgeIsHalfDashes', () => {
    const dashes = dashesAround(rectangle(0.4, 0.2), { x: 1, y: 1, angle: 0 });
    // Dashes of 5 cm and gaps: 4 on each side of 40 cm, 2 on each of 20 cm.
    expect(dashes).toHaveLength(12);
    const length = dashes.reduce((sum, [a, b]) => sum + Math.hypot(b.x - a.x, b.y - a.y), 0);
    expect(length).toBeCloseTo(0.6);
    expect(dashes[0]?.[0].x).toBeCloseTo(0.8);
    expect(dashes[0]?.[0].y).toBeCloseTo(0.9);
    expect(dashesAround(disc(0.05), { x: 0, y: 0, angle: 0 })).toHaveLength(16);
  });
});
