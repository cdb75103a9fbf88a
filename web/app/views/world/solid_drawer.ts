// The things of a world as three.js draws them: made when the stage changes, moved each frame.

import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  Color,
  CylinderGeometry,
  DynamicDrawUsage,
  ExtrudeGeometry,
  Group,
  LineSegments,
  LineBasicMaterial,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  RingGeometry,
  Shape as Outline,
  SphereGeometry,
  SRGBColorSpace,
  type Object3D,
} from 'three';
import type { Colour } from '../../../protocol/messages';
import { dashesAround, reachOf, type Shape } from '../../../core/world/geometry';
import { litLamps } from '../../../core/world/lamps';
import type { WorldModel } from '../../../core/world/model';
import { isLamp, type Thing } from '../../../core/world/stage';
import { gridStep, kWall } from '../../../core/world/view';
import { css, shown, type Colours } from './colours';
import { kConeHalf, reachAhead } from './draw';
import type { WorldOptions } from './options';
import { Lamps } from './solid_lamps';
import { shapeOfPlacing } from './placing';

const kWallHeight = 0.22;
/** Above the ground, so that flat things do not flicker, in m. */
const kPatch = 0.0015;
const kTrail = 0.004;

export class SolidDrawer {
  readonly root = new Group();
  private readonly ground = new Group();
  private readonly things = new Group();
  private readonly bodies = new Map<string, Object3D>();
  private readonly trails: Lines;
  private readonly robotsNow: Lines;
  private readonly rays: Lines;
  private readonly mark: Mesh;
  private readonly placed = new Group();
  private readonly lamps = new Lamps();
  private placing: unknown = null;
  private image: CanvasImageSource | null = null;

  constructor(
    private readonly model: WorldModel,
    private readonly colours: Colours,
  ) {
    this.trails = new Lines(colours.trail);
    this.robotsNow = new Lines(colours.front);
    this.rays = new Lines(colours.cone);
    this.mark = new Mesh(
      new RingGeometry(1, 1.14, 48),
      new MeshBasicMaterial({ color: colours.accent, depthTest: false, transparent: true }),
    );
    this.mark.renderOrder = 2;
    this.root.add(this.ground, this.things, this.trails.object, this.rays.object, this.mark);
    this.root.add(this.placed, this.robotsNow.object, this.lamps.object);
  }

  /** The stage is another one. */
  build(): void {
    drop(this.things);
    this.bodies.clear();
    for (const thing of this.model.stage.things) {
      const body = thing.kind === 'robot' ? this.robot(thing) : this.object(thing);
      this.bodies.set(thing.key, body);
      this.things.add(body);
    }
    this.buildGround();
  }

  move(options: WorldOptions): void {
    const { model } = this;
    if (this.image !== model.image) this.buildGround();
    for (const body of this.bodies.values()) body.visible = false;
    for (const { thing, pose } of model.standing()) {
      const body = this.bodies.get(thing.key);
      if (!body) continue;
      body.visible = true;
      body.position.set(pose.x, pose.y, body.position.z);
      body.rotation.z = pose.angle;
    }
    this.drawTrails(options);
    this.drawRays(options);
    this.lamps.show(litLamps(model));
    this.drawMark();
    this.drawNow();
    this.drawPlacing();
  }

  dispose(): void {
    for (const part of [this.ground, this.things, this.placed]) drop(part);
    this.trails.dispose();
    this.robotsNow.dispose();
    this.rays.dispose();
    this.lamps.dispose();
    this.mark.geometry.dispose();
  }

  // ---- the ground: one picture of it, with its grid ----

  private buildGround(): void {
    drop(this.ground);
    const { width, height, open, ground } = this.model.stage;
    this.image = this.model.image;
    const floor = new Mesh(
      new BoxGeometry(width, height, 0.02),
      new MeshBasicMaterial({ map: this.floorPicture(ground, width, height) }),
    );
    floor.position.set(width / 2, height / 2, -0.01);
    this.ground.add(floor);
    if (open) return;
    const wall = (x: number, y: number, w: number, h: number) => {
      const side = new MeshLambertMaterial({ color: this.colours.wallSide });
      const top = new MeshLambertMaterial({ color: this.colours.wall });
      // Faces of a box: +x, -x, +y, -y, +z, -z.
      const mesh = new Mesh(new BoxGeometry(w, h, kWallHeight), [side, side, side, side, top, top]);
      mesh.position.set(x, y, kWallHeight / 2);
      this.ground.add(mesh);
    };
    wall(width / 2, -kWall / 2, width + 2 * kWall, kWall);
    wall(width / 2, height + kWall / 2, width + 2 * kWall, kWall);
    wall(-kWall / 2, height / 2, kWall, height);
    wall(width + kWall / 2, height / 2, kWall, height);
  }

  private floorPicture(ground: Colour, width: number, height: number): CanvasTexture {
    const canvas = document.createElement('canvas');
    const scale = 1024 / Math.max(width, height);
    canvas.width = Math.round(width * scale);
    canvas.height = Math.round(height * scale);
    const context = canvas.getContext('2d');
    if (context) {
      context.fillStyle = css(shown(ground, true, this.colours.dark));
      context.fillRect(0, 0, canvas.width, canvas.height);
      if (this.model.image) context.drawImage(this.model.image, 0, 0, canvas.width, canvas.height);
      context.fillStyle = css([0, 0, 0], 0.1);
      const step = gridStep(scale, 60) * scale;
      for (let x = step; x < canvas.width - 1; x += step) context.fillRect(x, 0, 2, canvas.height);
      for (let y = canvas.height - step; y > 1; y -= step) context.fillRect(0, y, canvas.width, 2);
    }
    const texture = new CanvasTexture(canvas);
    texture.colorSpace = SRGBColorSpace;
    texture.anisotropy = 8;
    return texture;
  }

  // ---- bodies ----

  private object(thing: Thing): Object3D {
    const colour = colourOf(shown(thing.colour, thing.kind === 'patch', this.colours.dark));
    if (isLamp(thing.kind)) return this.lamp(thing);
    if (thing.kind === 'patch')
      return new Mesh(solidOf(thing.shape, kPatch), new MeshBasicMaterial({ color: colour }));
    const material = new MeshLambertMaterial({
      color: colour,
      ...(thing.later ? { transparent: true, opacity: 0.35 } : {}),
    });
    return new Mesh(solidOf(thing.shape, thing.height), material);
  }

  private lamp(thing: Thing): Object3D {
    const group = new Group();
    const height = Math.max(thing.height, 0.05);
    const colour = thing.kind === 'infrared' ? this.colours.cone : this.colours.front;
    const bulb = new Mesh(
      new SphereGeometry(Math.max(reachOf(thing.shape), 0.02), 20, 14),
      new MeshBasicMaterial({ color: thing.on ? colour : this.colours.robotSide }),
    );
    bulb.position.z = height;
    const stand = new Mesh(
      new CylinderGeometry(0.008, 0.012, height, 10).rotateX(Math.PI / 2),
      new MeshLambertMaterial({ color: this.colours.robotSide }),
    );
    stand.position.z = height / 2;
    group.add(bulb, stand);
    return group;
  }

  /** A dark body, its paint on the roof, and a wedge that points ahead. */
  private robot(thing: Thing): Object3D {
    const group = new Group();
    const body = new Mesh(
      solidOf(thing.shape, thing.height * 0.92),
      new MeshLambertMaterial({ color: this.colours.robot }),
    );
    const roof = new Mesh(
      solidOf(scaled(thing.shape, 0.72), thing.height * 0.08),
      new MeshLambertMaterial({ color: colourOf(thing.colour) }),
    );
    roof.position.z = thing.height * 0.92;
    const ahead = reachAhead(thing);
    const half = reachOf(thing.shape) * 0.4;
    const wedge = new Mesh(
      solidOf(
        {
          radius: 0,
          corners: [
            { x: ahead * 0.94, y: 0 },
            { x: ahead * 0.28, y: half },
            { x: ahead * 0.28, y: -half },
          ],
        },
        thing.height * 0.1,
      ),
      new MeshBasicMaterial({ color: this.colours.front }),
    );
    wedge.position.z = thing.height;
    group.add(body, roof, wedge);
    return group;
  }

  // ---- what changes with each frame ----

  private drawTrails({ trails, trailLength }: WorldOptions): void {
    const { model } = this;
    model.trails.limit = trailLength || Infinity;
    this.trails.begin();
    if (trails)
      for (const { thing } of model.standing()) {
        if (thing.kind !== 'robot') continue;
        const way = model.trails.of(thing.key);
        way.forEach((to, index) => {
          const from = way[index - 1];
          if (from && !to.begins) this.trails.ribbon(from, to, kTrail);
        });
      }
    this.trails.end();
  }

  private drawRays({ rays }: WorldOptions): void {
    const { model } = this;
    this.rays.begin();
    if (rays)
      for (const { robot, from, to } of model.looks()) {
        const thing = model.robotAt(robot);
        const z = (thing?.height ?? 0.05) * 0.5;
        this.rays.line(from, to, z);
        if (thing?.type !== 'carbot') continue;
        const angle = Math.atan2(to.y - from.y, to.x - from.x);
        const reach = Math.hypot(to.x - from.x, to.y - from.y);
        const rim = [-1, -0.5, 0, 0.5, 1].map((part) => ({
          x: from.x + Math.cos(angle + part * kConeHalf) * reach,
          y: from.y + Math.sin(angle + part * kConeHalf) * reach,
        }));
        rim.forEach((point, index) => {
          const next = rim[index + 1];
          if (next) this.rays.line(point, next, z);
        });
        for (const end of [rim[0], rim[4]]) if (end) this.rays.line(from, end, z);
      }
    this.rays.end();
  }

  private drawMark(): void {
    const chosen = this.model.chosen;
    const pose = chosen && this.model.poseOf(chosen);
    this.mark.visible = pose !== undefined && Number.isFinite(pose.x);
    if (!chosen || !pose || !this.mark.visible) return;
    this.mark.position.set(pose.x, pose.y, 0.01);
    this.mark.scale.setScalar(reachOf(chosen.shape) * 1.05);
  }

  /** While the past is shown: where robots are now, dashed, on the ground and as high as they are. */
  private drawNow(): void {
    this.robotsNow.begin();
    for (const { thing, pose } of this.model.robotsNow())
      for (const [from, to] of dashesAround(thing.shape, pose))
        for (const z of [0.01, thing.height]) this.robotsNow.ribbon(from, to, z);
    this.robotsNow.end();
  }

  private drawPlacing(): void {
    const { placing } = this.model;
    const what = placing && (placing.what === 'robot' ? placing.type : placing.kind);
    if (what !== this.placing) {
      drop(this.placed);
      this.placing = what;
      if (placing)
        this.placed.add(
          new Mesh(
            solidOf(shapeOfPlacing(placing).shape, 0.1),
            new MeshBasicMaterial({ color: this.colours.accent, transparent: true, opacity: 0.5 }),
          ),
        );
    }
    if (!placing) return;
    this.placed.position.set(placing.at.x, placing.at.y, 0);
    this.placed.rotation.z = placing.at.angle;
  }
}

/** Lines that are made again each frame in one buffer that only grows. */
class Lines {
  readonly object: LineSegments;
  private points = new Float32Array(3 * 256);
  private used = 0;

  constructor(colour: string) {
    this.object = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: colour }));
    this.object.frustumCulled = false;
  }

  begin(): void {
    this.used = 0;
  }

  line(from: { x: number; y: number }, to: { x: number; y: number }, z: number): void {
    if ((this.used + 2) * 3 > this.points.length) {
      const larger = new Float32Array(this.points.length * 2);
      larger.set(this.points);
      this.points = larger;
    }
    this.points.set([from.x, from.y, z, to.x, to.y, z], this.used * 3);
    this.used += 2;
  }

  /** Lines of WebGL are one pixel wide: three side by side are seen better. */
  ribbon(from: { x: number; y: number }, to: { x: number; y: number }, z: number): void {
    const length = Math.hypot(to.x - from.x, to.y - from.y) || 1;
    const x = (-(to.y - from.y) / length) * 0.004;
    const y = ((to.x - from.x) / length) * 0.004;
    for (const side of [-1, 0, 1])
      this.line(
        { x: from.x + x * side, y: from.y + y * side },
        { x: to.x + x * side, y: to.y + y * side },
        z,
      );
  }

  end(): void {
    const { geometry } = this.object;
    const there = geometry.getAttribute('position') as BufferAttribute | undefined;
    if (there?.array === this.points) there.needsUpdate = true;
    else {
      // A buffer on the card keeps its size: a larger one is another one.
      geometry.dispose();
      geometry.setAttribute(
        'position',
        new BufferAttribute(this.points, 3).setUsage(DynamicDrawUsage),
      );
    }
    geometry.setDrawRange(0, this.used);
  }

  dispose(): void {
    this.object.geometry.dispose();
  }
}

function solidOf(shape: Shape, height: number): BufferGeometry {
  if (shape.radius > 0)
    return new CylinderGeometry(shape.radius, shape.radius, height, 40)
      .rotateX(Math.PI / 2)
      .translate(0, 0, height / 2);
  const outline = new Outline();
  shape.corners.forEach(({ x, y }, index) =>
    index === 0 ? outline.moveTo(x, y) : outline.lineTo(x, y),
  );
  return new ExtrudeGeometry(outline, { depth: height, bevelEnabled: false });
}

function scaled({ radius, corners }: Shape, part: number): Shape {
  return {
    radius: radius * part,
    corners: corners.map(({ x, y }) => ({ x: x * part, y: y * part })),
  };
}

function colourOf(colour: Colour): Color {
  const [red = 0, green = 0, blue = 0] = colour;
  return new Color().setRGB(red, green, blue, SRGBColorSpace);
}

function drop(group: Group): void {
  group.traverse((one) => {
    if (!(one instanceof Mesh)) return;
    (one.geometry as BufferGeometry).dispose();
    for (const material of [one.material].flat() as MeshBasicMaterial[]) {
      material.map?.dispose();
      material.dispose();
    }
  });
  group.clear();
}
