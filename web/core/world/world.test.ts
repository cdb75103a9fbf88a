import { describe, expect, test } from 'vitest';
import type { Topics } from '../../protocol/messages';
import { readPicture, readPoses, readRays } from './frames';
import {
  disc,
  distanceTo,
  normalAngle,
  placed,
  radians,
  reachOf,
  rectangle,
  seenFrom,
  shownDegrees,
} from './geometry';
import { drawOrder, thingAt, thingOnRay, type Standing } from './hit';
import { WorldModel } from './model';
import { snapAngle, snapPoint, tidy } from './snap';
import { bodies, keyOfObject, keyOfRobot, stageOfScene, type Thing } from './stage';
import { kTrailPointsMax, Trails } from './trails';
import {
  fitted,
  gridStep,
  isBetterLow,
  lengthText,
  panned,
  toScreen,
  toWorld,
  zoomed,
} from './view';

const thing = (kind: Thing['kind'], more: Partial<Thing> = {}): Thing => ({
  key: kind,
  name: kind,
  kind,
  shape: rectangle(0.4, 0.2),
  pose: { x: 1, y: 1, angle: 0 },
  height: 0.2,
  colour: [1, 1, 1],
  on: true,
  later: false,
  ...more,
});
const stand = (one: Thing): Standing => ({ thing: one, pose: one.pose });

describe('geometry', () => {
  test('ThereAndBackAgainIsTheSamePlace', () => {
    const pose = { x: 2, y: -1, angle: 0.7 };
    const back = seenFrom(placed({ x: 0.3, y: 0.4 }, pose), pose);
    expect(back.x).toBeCloseTo(0.3);
    expect(back.y).toBeCloseTo(0.4);
  });
  test('AnAngleCountsToTheLeft', () => {
    const ahead = placed({ x: 1, y: 0 }, { x: 0, y: 0, angle: Math.PI / 2 });
    expect(ahead.x).toBeCloseTo(0);
    expect(ahead.y).toBeCloseTo(1);
  });
  test('DistanceIsZeroInsideAndCountsFromTheEdge', () => {
    expect(distanceTo(rectangle(2, 1), { x: 0.9, y: 0.4 })).toBe(0);
    expect(distanceTo(rectangle(2, 1), { x: 1.5, y: 0 })).toBeCloseTo(0.5);
    expect(distanceTo(rectangle(2, 1), { x: 1.3, y: 0.9 })).toBeCloseTo(0.5);
    expect(distanceTo(disc(0.5), { x: 0, y: 0.8 })).toBeCloseTo(0.3);
  });
  test('AnglesAreHalfATurnAtMost', () => {
    expect(normalAngle(3 * Math.PI)).toBeCloseTo(Math.PI);
    expect(normalAngle(-Math.PI / 2)).toBeCloseTo(-Math.PI / 2);
    expect(normalAngle(7)).toBeCloseTo(7 - 2 * Math.PI);
  });
  test('ABodyReachesToItsFarthestCorner', () => {
    expect(reachOf(bodies.epuck.shape)).toBe(0.037);
    expect(reachOf(rectangle(0.6, 0.8))).toBeCloseTo(0.5);
  });
});

describe('the view from above', () => {
  const screen = { width: 800, height: 600 };
  test('AFittedWorldIsInTheMiddleAndInside', () => {
    const view = fitted({ width: 6, height: 4.5 }, screen);
    expect(toScreen(view, screen, { x: 3, y: 2.25 })).toEqual({ x: 400, y: 300 });
    const corner = toScreen(view, screen, { x: 0, y: 4.5 });
    expect(corner.x).toBeGreaterThan(0);
    expect(corner.y).toBeGreaterThan(0);
  });
  test('APointOfTheScreenLeadsBackToItsPlace', () => {
    const view = { x: 1, y: 2, scale: 130 };
    const there = toWorld(view, screen, toScreen(view, screen, { x: 0.2, y: 3.1 }));
    expect(there.x).toBeCloseTo(0.2);
    expect(there.y).toBeCloseTo(3.1);
  });
  test('WhatIsUnderThePointerStaysThereWhenZoomed', () => {
    const view = { x: 1, y: 2, scale: 100 };
    const at = { x: 120, y: 500 };
    const before = toWorld(view, screen, at);
    const after = toWorld(zoomed(view, screen, at, 1.5), screen, at);
    expect(after.x).toBeCloseTo(before.x);
    expect(after.y).toBeCloseTo(before.y);
  });
  test('ZoomHasLimits', () => {
    const view = { x: 0, y: 0, scale: 100 };
    expect(zoomed(view, screen, { x: 0, y: 0 }, 1e9).scale).toBe(8000);
    expect(zoomed(view, screen, { x: 0, y: 0 }, 1e-9).scale).toBe(4);
  });
  test('AHandThatGoesRightTakesTheWorldAlong', () => {
    expect(panned({ x: 1, y: 1, scale: 100 }, { x: 50, y: 50 })).toEqual({
      x: 0.5,
      y: 1.5,
      scale: 100,
    });
  });
  test('GridsAreRoundAndNotTooNarrow', () => {
    expect(gridStep(100, 24)).toBeCloseTo(0.5);
    expect(gridStep(60, 48)).toBeCloseTo(1);
    expect(gridStep(5000, 24)).toBeCloseTo(0.005);
    expect([2, 0.5, 0.05, 0.005].map(lengthText)).toEqual(['2 m', '50 cm', '5 cm', '5 mm']);
  });
});

describe('snapping', () => {
  test('PlacesGoToTheGridAndAnglesToRoundDegrees', () => {
    expect(snapPoint({ x: 1.234, y: 0.77 }, 0.05)).toEqual({ x: 1.25, y: 0.75 });
    expect(snapAngle(radians(52), radians(15))).toBeCloseTo(radians(45), 3);
  });
  test('WithoutAStepOnlyTheDigitsOfComputingGo', () => {
    expect(snapPoint({ x: 0.1 + 0.2, y: -0.00001 }, 0)).toEqual({ x: 0.3, y: 0 });
    expect(tidy(1 / 3)).toBe(0.3333);
  });
});

describe('what is under the pointer', () => {
  const patch = thing('patch', { shape: disc(1) });
  const box = thing('box');
  const robot = thing('robot', { pose: { x: 1.1, y: 1, angle: 0 } });
  test('RobotsLieOverBoxesAndBoxesOverPatches', () => {
    const all = [robot, patch, box].map(stand);
    expect(thingAt(all, { x: 1.1, y: 1 }, 0)?.thing.kind).toBe('robot');
    expect(thingAt(all, { x: 0.85, y: 1 }, 0)?.thing.kind).toBe('box');
    expect(thingAt(all, { x: 1, y: 1.6 }, 0)?.thing.kind).toBe('patch');
    expect(thingAt(all, { x: 4, y: 4 }, 0.1)).toBeUndefined();
    expect(drawOrder(all).map((one) => one.thing.kind)).toEqual(['patch', 'box', 'robot']);
  });
  test('NearIsEnoughButInsideIsBetter', () => {
    const all = [stand(box), stand(thing('robot', { pose: { x: 1.5, y: 1, angle: 0 } }))];
    expect(thingAt([stand(box)], { x: 1.22, y: 1 }, 0.05)?.thing.kind).toBe('box');
    expect(thingAt(all, { x: 1.19, y: 1 }, 0.2)?.thing.kind).toBe('box');
  });
  test('ALookFromTheSideMeetsWhatStandsInFrontOfTheGround', () => {
    const wall = stand(thing('wall', { height: 1 }));
    const from = { x: 1, y: -2, z: 2 };
    // Without the wall it would meet the ground behind it.
    const met = thingOnRay([wall], { from, way: { x: 0, y: 4, z: -2 } }, 0);
    expect(met.hit?.thing.kind).toBe('wall');
    expect(met.ground?.y).toBeCloseTo(2);
    expect(thingOnRay([wall], { from, way: { x: 0, y: 1, z: 0.1 } }, 0).ground).toBeNull();
  });
});

describe('frames', () => {
  const bytes = (length: number, fill: (view: DataView) => void) => {
    const view = new DataView(new ArrayBuffer(length));
    fill(view);
    return view;
  };
  const poses = bytes(4 + 12 + 16, (view) => {
    view.setUint16(0, 1, true);
    view.setUint16(2, 1, true);
    [1.5, 2.5, 0.5].forEach((value, index) => view.setFloat32(4 + index * 4, value, true));
    view.setUint32(16, 7, true);
    [3.5, 4.5, -0.5].forEach((value, index) => view.setFloat32(20 + index * 4, value, true));
  });
  test('PosesAreRobotsInOrderAndObjectsByNumber', () => {
    expect(readPoses(poses)).toEqual({
      robots: [{ x: 1.5, y: 2.5, angle: 0.5 }],
      objects: [{ number: 7, pose: { x: 3.5, y: 4.5, angle: -0.5 } }],
    });
  });
  test('AFrameThatIsCutGivesWhatIsWhole', () => {
    const cut = new DataView(poses.buffer, 0, 20);
    expect(readPoses(cut)).toEqual({ robots: [{ x: 1.5, y: 2.5, angle: 0.5 }], objects: [] });
    expect(readPoses(new DataView(new ArrayBuffer(2)))).toEqual({ robots: [], objects: [] });
    expect(readRays(new DataView(new ArrayBuffer(0)))).toEqual({ looks: [], lamps: [] });
  });
  test('RaysAreLooksThenLamps', () => {
    const view = bytes(4 + 20 + 24, (at) => {
      at.setUint16(0, 1, true);
      at.setUint16(2, 1, true);
      at.setUint16(6, 1, true);
      [1, 2, 3, 4].forEach((value, index) => at.setFloat32(8 + index * 4, value, true));
      at.setUint16(24, 5, true);
      [0.5, -0.5, 1, 0, 0.25].forEach((value, index) => at.setFloat32(28 + index * 4, value, true));
    });
    expect(readRays(view)).toEqual({
      looks: [{ robot: 0, hit: true, from: { x: 1, y: 2 }, to: { x: 3, y: 4 } }],
      lamps: [{ robot: 5, at: { x: 0.5, y: -0.5 }, colour: [1, 0, 0.25] }],
    });
  });
  test('PicturesAreOpaqueAndWholeOrNotThere', () => {
    const view = bytes(4 + 6, (at) => {
      at.setUint16(0, 2, true);
      at.setUint16(2, 1, true);
      [1, 2, 3, 4, 5, 6].forEach((value, index) => at.setUint8(4 + index, value));
    });
    expect([...(readPicture(view)?.pixels ?? [])]).toEqual([1, 2, 3, 255, 4, 5, 6, 255]);
    expect(readPicture(new DataView(view.buffer, 0, 9))).toBeNull();
  });
});

describe('trails', () => {
  test('APointNearTheLastIsNotKept', () => {
    const trails = new Trails();
    for (const x of [0, 0.004, 0.02]) trails.add('a', { x, y: 0 });
    expect(trails.of('a').map((point) => point.x)).toEqual([0, 0.02]);
  });
  test('OnlyTheNewestMetresAreShown', () => {
    const trails = new Trails(1);
    for (let x = 0; x <= 3; x += 0.25) trails.add('a', { x, y: 0 });
    expect(trails.of('a').at(0)?.x).toBeCloseTo(2);
    trails.limit = Infinity;
    expect(trails.of('a')).toHaveLength(13);
  });
  test('PutElsewhereTheLineBeginsAnewAndBackInTimeItIsGone', () => {
    const trails = new Trails();
    trails.at(5);
    trails.add('a', { x: 0, y: 0 });
    trails.add('a', { x: 3, y: 0 });
    expect(trails.of('a').at(1)?.begins).toBe(true);
    trails.at(1);
    expect(trails.of('a')).toEqual([]);
  });
  test('TheyDoNotGrowForEver', () => {
    const trails = new Trails(Infinity);
    for (let index = 0; index < kTrailPointsMax + 10; index++)
      trails.add('a', { x: index * 0.02, y: 0 });
    expect(trails.of('a')).toHaveLength(kTrailPointsMax);
  });
});

describe('a world that is looked at', () => {
  const scene: Topics['scene']['is'] = {
    name: 'Hall',
    size: [6, 4.5],
    open: false,
    ground: [1, 1, 1],
    robots: [
      {
        name: 'anna',
        type: 'epuck',
        nodes: [1],
        outline: [],
        paint: [1, 0, 0],
        height: 0.05,
        camera: true,
        buttons: [],
      },
    ],
    objects: [
      {
        id: 'crate',
        number: 4,
        kind: 'box',
        size: [0.2, 0.2],
        height: 0.1,
        mass: 1,
        colour: [1, 1, 1],
        on: true,
      },
    ],
  };
  const made = () => {
    const model = new WorldModel();
    model.setStage(stageOfScene(scene));
    model.setPoses(1, {
      robots: [{ x: 1, y: 1, angle: 0 }],
      objects: [{ number: 4, pose: { x: 2, y: 2, angle: 0 } }],
    });
    return model;
  };
  test('WhatHasNoPlaceYetIsNotDrawn', () => {
    const model = new WorldModel();
    model.setStage(stageOfScene(scene));
    expect(model.standing()).toEqual([]);
    expect(
      made()
        .standing()
        .map((one) => one.thing.key),
    ).toEqual(['object:4', 'robot:anna']);
  });
  test('AThingInAHandStaysThereWhateverFramesSay', () => {
    const model = made();
    const anna = model.robotAt(0);
    model.hold(keyOfRobot('anna'), { x: 3, y: 3, angle: 1 });
    model.setPoses(2, { robots: [{ x: 1.1, y: 1, angle: 0 }], objects: [] });
    expect(anna && model.poseOf(anna).x).toBe(3);
    model.letGo(keyOfRobot('anna'));
    expect(anna && model.poseOf(anna).x).toBe(1.1);
  });
  test('FramesDrawAndDoNotTellForms', () => {
    const model = made();
    const { count } = model.changed;
    let drawn = 0;
    model.drawn.on(() => drawn++);
    for (let t = 2; t < 32; t++)
      model.setPoses(t, { robots: [{ x: t, y: 1, angle: 0 }], objects: [] });
    expect(drawn).toBe(30);
    expect(model.changed.count).toBe(count);
  });
  test('TheSelectionGoesAroundAndEndsWithItsThing', () => {
    const model = made();
    model.step(1);
    expect(model.selected).toBe(keyOfObject(4));
    model.step(1);
    model.step(1);
    expect(model.selected).toBe(keyOfObject(4));
    model.setStage(stageOfScene({ ...scene, objects: [] }));
    expect(model.selected).toBeNull();
  });
  test('TheViewGoesWithTheRobotThatIsFollowed', () => {
    const model = made();
    model.resize({ width: 400, height: 300 });
    expect(model.seen().x).toBe(3);
    model.follow(keyOfRobot('anna'));
    expect(model.seen()).toMatchObject({ x: 1, y: 1 });
    model.fit();
    expect(model.seen().x).toBe(3);
  });
  test('SomethingNewGoesWhereNothingStands', () => {
    const model = made();
    model.resize({ width: 400, height: 300 });
    expect(model.freePlace(0.2)).toEqual({ x: 3, y: 2.25 });
    model.setPoses(2, { robots: [{ x: 3, y: 2.25, angle: 0 }], objects: [] });
    const { x, y } = model.freePlace(0.2);
    expect(Math.hypot(x - 3, y - 2.25)).toBeGreaterThan(0.2);
  });
});

test('AnglesAreShownFromMinus180To180', () => {
  const shown = [396, -359.5, 180, -180, 0, 725].map((given) => shownDegrees(radians(given)));
  expect(shown.map((one) => Math.round(one * 10) / 10)).toEqual([36, 0.5, 180, 180, 0, 5]);
});

test('a picture at the right is where the robot is not, and does not jump to and fro', () => {
  const screen = { width: 400, height: 300 };
  const far = { x: 100, y: 20 };
  expect(isBetterLow(screen, far, false)).toBe(false);
  expect(isBetterLow(screen, far, true)).toBe(true);
  expect(isBetterLow(screen, { x: 300, y: 20 }, false)).toBe(true);
  expect(isBetterLow(screen, { x: 300, y: 280 }, true)).toBe(false);
  // About the middle it stays.
  for (const isLow of [true, false])
    expect(isBetterLow(screen, { x: 300, y: 150 }, isLow)).toBe(isLow);
  expect(isBetterLow(screen, { x: NaN, y: NaN }, false)).toBe(false);
});
