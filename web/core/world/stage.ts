// What is in a world, as views draw it: of a run (topic scene) or of a world file.

import type { Colour, Robot, SceneObject, Topics } from '../../protocol/messages';
import { disc, rectangle, type Pose, type Shape } from './geometry';

export type RobotType = Robot['type'];
export type ObjectKind = SceneObject['kind'];

export interface Thing {
  /** One thing keeps its key as long as it is there. */
  key: string;
  name: string;
  kind: ObjectKind | 'robot';
  type?: RobotType;
  shape: Shape;
  /** Where it is unless a frame of poses says otherwise. */
  pose: Pose;
  height: number;
  colour: Colour;
  /** A light that shines. */
  on: boolean;
  /** It comes later, by the timeline: drawn as an outline. */
  later: boolean;
}

export interface Stage {
  name: string;
  width: number;
  height: number;
  open: boolean;
  ground: Colour;
  image: string | null;
  things: readonly Thing[];
}

/** What a light without a size is drawn and touched as, in m. */
export const kLampRadius = 0.05;

export const robotTypes: readonly RobotType[] = ['thymio2', 'epuck', 'carbot'];
export const objectKinds: readonly ObjectKind[] = [
  'wall',
  'box',
  'cylinder',
  'patch',
  'light',
  'infrared',
];

export function isRobotType(value: unknown): value is RobotType {
  return robotTypes.some((type) => type === value);
}

export function isObjectKind(value: unknown): value is ObjectKind {
  return objectKinds.some((kind) => kind === value);
}

export function isLamp(kind: Thing['kind']): boolean {
  return kind === 'light' || kind === 'infrared';
}

/** For worlds that do not run; a run tells its own (src/sim/…/body.cpp). */
export const bodies: Record<RobotType, { shape: Shape; height: number }> = {
  thymio2: {
    shape: {
      radius: 0,
      corners: [
        { x: -0.03, y: -0.056 },
        { x: 0.045, y: -0.056 },
        { x: 0.063, y: -0.05 },
        { x: 0.08, y: -0.016 },
        { x: 0.08, y: 0.016 },
        { x: 0.063, y: 0.05 },
        { x: 0.045, y: 0.056 },
        { x: -0.03, y: 0.056 },
      ],
    },
    height: 0.053,
  },
  epuck: { shape: disc(0.037), height: 0.047 },
  carbot: {
    shape: {
      radius: 0,
      corners: [
        { x: 0.2, y: -0.145 },
        { x: 0.2, y: 0.145 },
        { x: 0.17, y: 0.175 },
        { x: -0.17, y: 0.175 },
        { x: -0.2, y: 0.145 },
        { x: -0.2, y: -0.145 },
        { x: -0.17, y: -0.175 },
        { x: 0.17, y: -0.175 },
      ],
    },
    height: 0.22,
  },
};

export function shapeOf(size: readonly number[] | undefined, radius: number): Shape {
  if (radius > 0) return disc(radius);
  return size ? rectangle(size[0] ?? 0, size[1] ?? 0) : disc(kLampRadius);
}

/** A running world; where things are comes by frames of poses. */
export function stageOfScene(scene: Topics['scene']['is']): Stage {
  const [width = 1, height = 1] = scene.size;
  return {
    name: scene.name,
    width,
    height,
    open: scene.open,
    ground: scene.ground,
    image: scene.image ?? null,
    things: [...scene.objects.map(thingOfObject), ...scene.robots.map(thingOfRobot)],
  };
}

export const keyOfRobot = (name: string) => `robot:${name}`;
export const keyOfObject = (number: number) => `object:${number}`;

const nowhere: Pose = { x: NaN, y: NaN, angle: 0 };

function thingOfRobot(robot: Robot): Thing {
  const corners = robot.outline.map(([x = 0, y = 0]) => ({ x, y }));
  return {
    key: keyOfRobot(robot.name),
    name: robot.name,
    kind: 'robot',
    type: robot.type,
    shape: corners.length > 2 ? { corners, radius: 0 } : bodies[robot.type].shape,
    pose: nowhere,
    height: robot.height,
    colour: robot.paint,
    on: true,
    later: false,
  };
}

function thingOfObject(object: SceneObject): Thing {
  return {
    key: keyOfObject(object.number),
    name: object.id,
    kind: object.kind,
    shape: shapeOf(object.size, object.radius ?? 0),
    pose: nowhere,
    height: object.height,
    colour: object.colour,
    on: object.on,
    later: false,
  };
}
