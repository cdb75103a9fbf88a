// Frames of the topics poses, rays and picture: how their bytes are read. A frame that is cut short
// gives what is whole in it.

import type { Colour, Json } from '../../protocol/messages';
import type { Point, Pose } from './geometry';

export interface PosesFrame {
  /** In the order of the scene. */
  robots: Pose[];
  objects: { number: number; pose: Pose }[];
}

export interface Look {
  robot: number;
  hit: boolean;
  /** In the frame of the robot. */
  from: Point;
  to: Point;
}

export interface Lamp {
  robot: number;
  /** In the frame of the robot. */
  at: Point;
  colour: Colour;
}

export interface RaysFrame {
  looks: Look[];
  lamps: Lamp[];
}

export interface PictureFrame {
  width: number;
  height: number;
  /** Red, green, blue, opaque; row by row from the top. */
  pixels: Uint8ClampedArray<ArrayBuffer>;
}

const kRobotBytes = 12;
const kObjectBytes = 16;
const kLookBytes = 20;
const kLampBytes = 24;

export function readPoses(bytes: DataView): PosesFrame {
  const frame: PosesFrame = { robots: [], objects: [] };
  if (bytes.byteLength < 4) return frame;
  const robots = bytes.getUint16(0, true);
  const objects = bytes.getUint16(2, true);
  let at = 4;
  for (let i = 0; i < robots && at + kRobotBytes <= bytes.byteLength; i++, at += kRobotBytes)
    frame.robots.push(poseAt(bytes, at));
  for (let i = 0; i < objects && at + kObjectBytes <= bytes.byteLength; i++, at += kObjectBytes)
    frame.objects.push({ number: bytes.getUint32(at, true), pose: poseAt(bytes, at + 4) });
  return frame;
}

/** Where things were at an instant of the past, as the server tells it. */
export function posesThen(instant: {
  robots: readonly Json[];
  objects: readonly Json[];
}): PosesFrame {
  const frame: PosesFrame = { robots: [], objects: [] };
  for (const one of instant.robots) {
    const [index, x, y, angle] = numbersOf(one);
    frame.robots[index] = { x, y, angle };
  }
  for (const one of instant.objects) {
    const [number, x, y, angle] = numbersOf(one);
    frame.objects.push({ number, pose: { x, y, angle } });
  }
  return frame;
}

function numbersOf(json: Json): [number, number, number, number] {
  const list = Array.isArray(json) ? json : [];
  const at = (index: number) => Number(list[index] ?? NaN);
  return [at(0), at(1), at(2), at(3)];
}

export function readRays(bytes: DataView): RaysFrame {
  const frame: RaysFrame = { looks: [], lamps: [] };
  if (bytes.byteLength < 4) return frame;
  const looks = bytes.getUint16(0, true);
  const lamps = bytes.getUint16(2, true);
  let at = 4;
  for (let i = 0; i < looks && at + kLookBytes <= bytes.byteLength; i++, at += kLookBytes)
    frame.looks.push({
      robot: bytes.getUint16(at, true),
      hit: bytes.getUint16(at + 2, true) !== 0,
      from: pointAt(bytes, at + 4),
      to: pointAt(bytes, at + 12),
    });
  for (let i = 0; i < lamps && at + kLampBytes <= bytes.byteLength; i++, at += kLampBytes)
    frame.lamps.push({
      robot: bytes.getUint16(at, true),
      at: pointAt(bytes, at + 4),
      colour: [
        bytes.getFloat32(at + 12, true),
        bytes.getFloat32(at + 16, true),
        bytes.getFloat32(at + 20, true),
      ],
    });
  return frame;
}

export function readPicture(bytes: DataView): PictureFrame | null {
  if (bytes.byteLength < 4) return null;
  const width = bytes.getUint16(0, true);
  const height = bytes.getUint16(2, true);
  if (width === 0 || height === 0 || bytes.byteLength < 4 + width * height * 3) return null;
  const pixels = new Uint8ClampedArray(width * height * 4);
  for (let from = 4, to = 0; to < pixels.length; from += 3, to += 4) {
    pixels[to] = bytes.getUint8(from);
    pixels[to + 1] = bytes.getUint8(from + 1);
    pixels[to + 2] = bytes.getUint8(from + 2);
    pixels[to + 3] = 255;
  }
  return { width, height, pixels };
}

function pointAt(bytes: DataView, at: number): Point {
  return { x: bytes.getFloat32(at, true), y: bytes.getFloat32(at + 4, true) };
}

function poseAt(bytes: DataView, at: number): Pose {
  return { ...pointAt(bytes, at), angle: bytes.getFloat32(at + 8, true) };
}
