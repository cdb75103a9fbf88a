// A development tool: a world that pretends to run, made from the example's file. The robot drives
// in a rounded square; a hand may move, put, take. Not shipped.

import type { Json, Robot, SceneObject, Topics } from '../protocol/messages';
import { bodies, type Thing } from '../core/world/stage';
import { stageOfFile } from '../core/world/file';
import type { Pose } from '../core/world/geometry';

export interface StandInWorld {
  scene: Topics['scene']['is'];
  poses: Map<string, Pose>;
  /** Robots that a hand has put somewhere stay there. */
  put: Set<string>;
  objects: Map<number, Pose>;
  next: number;
}

export function makeWorld(file: Json, robots = 1): StandInWorld {
  const stage = stageOfFile(file);
  const world: StandInWorld = {
    scene: {
      name: stage.name,
      size: [stage.width, stage.height],
      open: stage.open,
      ground: stage.ground,
      robots: [],
      objects: [],
    },
    poses: new Map(),
    put: new Set(),
    objects: new Map(),
    next: 1,
  };
  for (const thing of stage.things)
    if (thing.kind === 'robot') addRobot(world, thing, thing.name);
    else if (!thing.later) addObject(world, thing);
  const first = stage.things.find((thing) => thing.kind === 'robot');
  for (let index = 1; first && index < robots; index++)
    addRobot(
      world,
      {
        ...first,
        type: 'thymio2',
        ...bodies.thymio2,
        pose: {
          x: 0.3 + (index % 14) * 0.4,
          y: 0.3 + Math.floor(index / 14) * 0.5,
          angle: index,
        },
      },
      `thymio${index}`,
    );
  return world;
}

function addRobot(world: StandInWorld, thing: Thing, name: string): void {
  const type = thing.type ?? 'carbot';
  const robot: Robot = {
    name,
    type,
    nodes: [1],
    outline: thing.shape.corners.map(({ x, y }) => [x, y]),
    paint: thing.colour,
    height: thing.height,
    camera: type !== 'thymio2',
    buttons: type === 'thymio2' ? ['backward', 'left', 'center', 'forward', 'right'] : ['escape'],
  };
  world.scene = { ...world.scene, robots: [...world.scene.robots, robot] };
  world.poses.set(name, thing.pose);
}

export function addObject(
  world: StandInWorld,
  thing: Pick<Thing, 'name' | 'kind' | 'shape' | 'height' | 'colour' | 'pose'>,
): number {
  const number = world.next++;
  const [corner] = thing.shape.corners;
  const object: SceneObject = {
    id: thing.name,
    number,
    kind: thing.kind === 'robot' ? 'box' : thing.kind,
    height: thing.height,
    mass: 0,
    colour: thing.colour,
    on: true,
    ...(corner
      ? { size: [Math.abs(corner.x) * 2, Math.abs(corner.y) * 2] }
      : { radius: thing.shape.radius }),
  };
  world.scene = { ...world.scene, objects: [...world.scene.objects, object] };
  world.objects.set(number, thing.pose);
  return number;
}

/** Moves what drives by itself. */
export function drive(world: StandInWorld, seconds: number): void {
  world.scene.robots.forEach(({ name }, index) => {
    const pose = world.poses.get(name);
    if (!pose || world.put.has(name)) return;
    const speed = 0.2 * seconds;
    const turn = (0.35 + (index % 5) * 0.1) * seconds;
    world.poses.set(name, {
      x: pose.x + Math.cos(pose.angle) * speed,
      y: pose.y + Math.sin(pose.angle) * speed,
      angle: pose.angle + turn,
    });
  });
}

export function posesFrame(world: StandInWorld, watch: number, t: number): Buffer {
  const { robots } = world.scene;
  const objects = [...world.objects];
  const frame = headed(3, watch, t, 4 + robots.length * 12 + objects.length * 16);
  frame.writeUInt16LE(robots.length, 16);
  frame.writeUInt16LE(objects.length, 18);
  let at = 20;
  const pose = ({ x, y, angle }: Pose) => {
    for (const value of [x, y, angle]) at = frame.writeFloatLE(value, at);
  };
  for (const { name } of robots) pose(world.poses.get(name) ?? { x: 0, y: 0, angle: 0 });
  for (const [number, where] of objects) {
    at = frame.writeUInt32LE(number, at);
    pose(where);
  }
  return frame;
}

export function raysFrame(world: StandInWorld, watch: number, t: number): Buffer {
  const { robots } = world.scene;
  const frame = headed(4, watch, t, 4 + robots.length * (20 + 24));
  frame.writeUInt16LE(robots.length, 16);
  frame.writeUInt16LE(robots.length, 18);
  let at = 20;
  robots.forEach(({ name, type }, index) => {
    const pose = world.poses.get(name) ?? { x: 0, y: 0, angle: 0 };
    const reach = type === 'carbot' ? 1.1 : 0.15;
    const ahead = type === 'carbot' ? 0.18 : 0.08;
    const angle = pose.angle - (type === 'carbot' ? 1.2 : 0);
    const from = [pose.x + Math.cos(pose.angle) * ahead, pose.y + Math.sin(pose.angle) * ahead];
    at = frame.writeUInt16LE(index, at);
    at = frame.writeUInt16LE(1, at);
    for (const value of [
      from[0] ?? 0,
      from[1] ?? 0,
      (from[0] ?? 0) + Math.cos(angle) * reach,
      (from[1] ?? 0) + Math.sin(angle) * reach,
    ])
      at = frame.writeFloatLE(value, at);
  });
  robots.forEach((_, index) => {
    at = frame.writeUInt16LE(index, at);
    at = frame.writeUInt16LE(0, at);
    for (const value of [-0.08, 0, 0.2, 0.9, 0.4]) at = frame.writeFloatLE(value, at);
  });
  return frame;
}

export function pictureFrame(watch: number, t: number): Buffer {
  const [width, height] = [60, 40];
  const frame = headed(5, watch, t, 4 + width * height * 3);
  frame.writeUInt16LE(width, 16);
  frame.writeUInt16LE(height, 18);
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) {
      const post = Math.abs(x - 30 - 20 * Math.sin(t / 2)) < 5 && y > 10 && y < 30;
      const colour = post ? [190, 128, 64] : y < 18 ? [120, 132, 158] : [210, 206, 196];
      colour.forEach((part, index) => frame.writeUInt8(part, 20 + (y * width + x) * 3 + index));
    }
  return frame;
}

function headed(kind: number, watch: number, t: number, bytes: number): Buffer {
  const frame = Buffer.alloc(16 + bytes);
  frame.writeUInt8(kind, 0);
  frame.writeUInt32LE(watch, 4);
  frame.writeDoubleLE(t, 8);
  return frame;
}
