// Points and shapes on the ground, in metres; angles in radians, counter-clockwise; x right, y up.

export interface Point {
  x: number;
  y: number;
}

export interface Pose extends Point {
  angle: number;
}

/** A polygon around the origin, or a disc if radius is above 0. */
export interface Shape {
  corners: readonly Point[];
  radius: number;
}

export function rectangle(width: number, length: number): Shape {
  const x = width / 2;
  const y = length / 2;
  return {
    corners: [
      { x: -x, y: -y },
      { x, y: -y },
      { x, y },
      { x: -x, y },
    ],
    radius: 0,
  };
}

export function disc(radius: number): Shape {
  return { corners: [], radius };
}

/** From the frame of a thing to that of the world. */
export function placed(point: Point, pose: Pose): Point {
  const cos = Math.cos(pose.angle);
  const sin = Math.sin(pose.angle);
  return {
    x: pose.x + point.x * cos - point.y * sin,
    y: pose.y + point.x * sin + point.y * cos,
  };
}

/** The edge of a shape as dashes of about that length, in the frame of the world. */
export function dashesAround(shape: Shape, pose: Pose, length = 0.05): [Point, Point][] {
  const corners = shape.radius > 0 ? corneredDisc(shape.radius) : shape.corners;
  return corners.flatMap((from, index) => {
    const to = corners[(index + 1) % corners.length] ?? from;
    const count = Math.max(1, Math.round(distance(from, to) / (2 * length)));
    const along = (part: number) =>
      placed({ x: from.x + (to.x - from.x) * part, y: from.y + (to.y - from.y) * part }, pose);
    return Array.from({ length: count }, (_, dash): [Point, Point] => [
      along(dash / count),
      along((dash + 0.5) / count),
    ]);
  });
}

function corneredDisc(radius: number): Point[] {
  return Array.from({ length: 16 }, (_, index) => {
    const angle = (index * Math.PI) / 8;
    return { x: radius * Math.cos(angle), y: radius * Math.sin(angle) };
  });
}

/** From the frame of the world to that of a thing. */
export function seenFrom(point: Point, pose: Pose): Point {
  const cos = Math.cos(pose.angle);
  const sin = Math.sin(pose.angle);
  const x = point.x - pose.x;
  const y = point.y - pose.y;
  return { x: x * cos + y * sin, y: -x * sin + y * cos };
}

export function distance(a: Point, b: Point): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}

/** How far a point is outside of a shape at the origin; 0 inside. */
export function distanceTo(shape: Shape, point: Point): number {
  if (shape.radius > 0) return Math.max(0, Math.hypot(point.x, point.y) - shape.radius);
  if (isInside(shape.corners, point)) return 0;
  let least = Infinity;
  shape.corners.forEach((from, index) => {
    const to = shape.corners[(index + 1) % shape.corners.length] ?? from;
    least = Math.min(least, distanceToLine(point, from, to));
  });
  return least;
}

/** How far a shape reaches from its origin. */
export function reachOf(shape: Shape): number {
  return shape.corners.reduce(
    (most, corner) => Math.max(most, Math.hypot(corner.x, corner.y)),
    shape.radius,
  );
}

/** The same direction, from -π to π. */
export function normalAngle(angle: number): number {
  const turn = 2 * Math.PI;
  const rest = (((angle + Math.PI) % turn) + turn) % turn;
  return rest === 0 ? Math.PI : rest - Math.PI;
}

/** What a person reads: -180 to 180. */
export function shownDegrees(angle: number): number {
  return degrees(normalAngle(angle));
}

export function degrees(angle: number): number {
  return (angle * 180) / Math.PI;
}

export function radians(angle: number): number {
  return (angle * Math.PI) / 180;
}

function isInside(corners: readonly Point[], { x, y }: Point): boolean {
  let inside = false;
  corners.forEach((a, index) => {
    const b = corners[(index + 1) % corners.length] ?? a;
    if (a.y > y !== b.y > y && x < ((b.x - a.x) * (y - a.y)) / (b.y - a.y) + a.x) inside = !inside;
  });
  return inside;
}

function distanceToLine(point: Point, from: Point, to: Point): number {
  const x = to.x - from.x;
  const y = to.y - from.y;
  const square = x * x + y * y;
  const part = square === 0 ? 0 : ((point.x - from.x) * x + (point.y - from.y) * y) / square;
  const at = Math.min(1, Math.max(0, part));
  return Math.hypot(point.x - from.x - at * x, point.y - from.y - at * y);
}
