// What a view of a world looks at: the things, where they are at the moment, what is chosen. Frames
// come many times a second, so all that draws is told by one emitter and reads from here; nothing of
// it goes through React.

import { Emitter } from '../emitter';
import type { Lamp, Look, PosesFrame, RaysFrame } from './frames';
import { placed, reachOf, type Point, type Pose } from './geometry';
import { drawOrder, type Standing } from './hit';
import { keyOfObject, type ObjectKind, type RobotType, type Stage, type Thing } from './stage';
import { Trails } from './trails';
import { fitted, type Extent, type View } from './view';

export type Placing =
  { what: 'object'; kind: ObjectKind; at: Pose } | { what: 'robot'; type: RobotType; at: Pose };

/**
 * holds: the thing follows the pointer; done: the hand has let go; key: one key of perhaps many, which
 * one undo takes back together.
 */
export type MoveBy = 'holds' | 'done' | 'key';

/** What a hand does in a world: in a run, or in its file. */
export interface WorldActs {
  /** False: it can only be looked at. */
  may: boolean;
  edits: boolean;
  move(thing: Thing, pose: Pose, by: MoveBy): void;
  put(placing: Placing): void;
  take(thing: Thing): void;
  light?(thing: Thing, on: boolean): void;
  /** A frame of poses was received: what a hand holds there is put back into it. */
  again?(): void;
}

const emptyStage: Stage = {
  name: '',
  width: 1,
  height: 1,
  open: false,
  ground: [1, 1, 1],
  image: null,
  things: [],
};

export class WorldModel {
  /** Something is to be drawn again. */
  readonly drawn = new Emitter<void>();
  /** Stage, selection or what is being placed changed: forms and lists. */
  readonly changed = new Emitter<void>();
  /** Said to those who listen: where something is now. */
  readonly spoken = new Emitter<string>();
  /** Counts up with changed, for useSyncExternalStore. */

  stage: Stage = emptyStage;
  selected: string | null = null;
  /** An entry of the timeline of a file; what it adds is chosen as a thing. */
  entry: string | null = null;
  hovered: string | null = null;
  placing: Placing | null = null;
  follows: string | null = null;
  /** A hand turns the chosen thing. */
  turning = false;
  acts: WorldActs | null = null;
  image: CanvasImageSource | null = null;

  view: View | null = null;
  /** Until a hand moves the view it fits the world, whatever the size of the panel. */
  fits = true;
  screen: Extent = { width: 0, height: 0 };

  trails = new Trails();
  lamps: readonly Lamp[] = [];
  t = 0;

  private rays: readonly Look[] = [];
  private poses = new Map<string, Pose>();
  private held = new Map<string, Pose>();
  private readonly then = new Map<string, Pose>();
  private order: Standing[] | null = null;
  private robots: Thing[] = [];

  // ---- what is where ----

  setStage(stage: Stage): void {
    const { width, height } = this.stage;
    this.stage = stage;
    this.robots = stage.things.filter((thing) => thing.kind === 'robot');
    if (this.selected !== null && !this.thing(this.selected)) this.selected = null;
    if (this.follows !== null && !this.thing(this.follows)) this.follows = null;
    if (width !== stage.width || height !== stage.height) this.fits = true;
    this.moved();
    this.tell();
  }

  /** Those of a run are one for all its views (ways.ts). */
  show(trails: Trails): void {
    this.trails = trails;
    this.drawn.emit();
  }

  /** What a hand may do from now on. */
  allow(acts: WorldActs): void {
    this.acts = acts;
  }

  /** The picture that lies on the ground; null: it has its colour. */
  cover(image: CanvasImageSource | null): void {
    if (image === this.image) return;
    this.image = image;
    this.drawn.emit();
  }

  setPoses(t: number, frame: PosesFrame): void {
    this.t = t;
    this.trails.at(t);
    frame.robots.forEach((pose, index) => {
      const robot = this.robots[index];
      if (!robot) return;
      this.poses.set(robot.key, pose);
      this.trails.add(robot.key, pose);
    });
    for (const { number, pose } of frame.objects) this.poses.set(keyOfObject(number), pose);
    this.moved();
    this.acts?.again?.();
  }

  /** Where the run has it, whatever a hand holds. */
  poseInRun(thing: Thing): Pose | undefined {
    return this.poses.get(thing.key);
  }

  /** Things as they were then, while those of now are remembered; null: now again. */
  showThen(frame: PosesFrame | null): void {
    if (!frame && this.then.size === 0) return;
    this.then.clear();
    frame?.robots.forEach((pose, index) => {
      const robot = this.robots[index];
      if (robot) this.then.set(robot.key, pose);
    });
    for (const { number, pose } of frame?.objects ?? []) this.then.set(keyOfObject(number), pose);
    this.moved();
  }

  /** Where robots are now, while the past is shown. */
  robotsNow(): readonly Standing[] {
    if (this.then.size === 0) return [];
    return this.robots.flatMap((thing) => {
      const pose = this.poses.get(thing.key);
      return pose ? [{ thing, pose }] : [];
    });
  }

  setRays({ looks, lamps }: RaysFrame): void {
    this.rays = looks;
    this.lamps = lamps;
    this.drawn.emit();
  }

  /** Where sensors look, in the world: from where their robots are shown. */
  looks(): Look[] {
    return this.rays.flatMap((look) => {
      const thing = this.robotAt(look.robot);
      if (!thing) return [];
      const pose = this.poseOf(thing);
      return [{ ...look, from: placed(look.from, pose), to: placed(look.to, pose) }];
    });
  }

  /** In the order of the scene. */
  get robotKeys(): readonly string[] {
    return this.robots.map((robot) => robot.key);
  }

  robotAt(index: number): Thing | undefined {
    return this.robots[index];
  }

  thing(key: string | null): Thing | undefined {
    return key === null ? undefined : this.stage.things.find((thing) => thing.key === key);
  }

  get chosen(): Thing | undefined {
    return this.thing(this.selected);
  }

  poseOf(thing: Thing): Pose {
    const then = this.then.get(thing.key);
    return then ?? this.held.get(thing.key) ?? this.poses.get(thing.key) ?? thing.pose;
  }

  /** Everything whose place is known, from the ground up. */
  standing(): readonly Standing[] {
    this.order ??= drawOrder(
      this.stage.things.flatMap((thing) => {
        const pose = this.poseOf(thing);
        return Number.isFinite(pose.x) ? [{ thing, pose }] : [];
      }),
    );
    return this.order;
  }

  /** A hand holds it there until let go, whatever frames say. */
  hold(key: string, pose: Pose): void {
    this.held.set(key, pose);
    this.moved();
  }

  letGo(key: string): void {
    if (this.held.delete(key)) this.moved();
  }

  // ---- what is chosen ----

  select(key: string | null): void {
    if (this.selected === key && this.entry === null) return;
    this.selected = key;
    this.entry = null;
    this.placing = null;
    this.tell();
  }

  selectEntry(key: string | null): void {
    if (this.entry === key) return;
    this.entry = key;
    this.selected = this.thing(key) ? key : null;
    this.tell();
  }

  /** The next or previous thing of the list. */
  step(by: 1 | -1): void {
    const { things } = this.stage;
    if (things.length === 0) return;
    const now = things.findIndex((thing) => thing.key === this.selected);
    const next = now < 0 ? (by === 1 ? 0 : things.length - 1) : now + by;
    this.select(things[(next + things.length) % things.length]?.key ?? null);
  }

  hover(key: string | null): void {
    if (this.hovered === key) return;
    this.hovered = key;
    this.drawn.emit();
  }

  place(placing: Placing | null): void {
    this.placing = placing;
    this.tell();
  }

  movePlacing(pose: Pose): void {
    if (!this.placing) return;
    this.placing = { ...this.placing, at: pose };
    this.drawn.emit();
  }

  follow(key: string | null): void {
    this.follows = key;
    this.fits = false;
    this.tell();
  }

  // ---- what is seen ----

  fit(): void {
    this.fits = true;
    this.follows = null;
    this.tell();
  }

  look(view: View): void {
    this.fits = false;
    this.view = view;
    this.drawn.emit();
  }

  resize(screen: Extent): void {
    this.screen = screen;
    this.drawn.emit();
  }

  /** The view of this moment: fitted, where a hand put it, or with the robot that is followed. */
  seen(): View {
    const { width, height } = this.stage;
    if (this.fits || !this.view) this.view = fitted({ width, height }, this.screen);
    const followed = this.thing(this.follows);
    const pose = followed && this.poseOf(followed);
    if (pose && Number.isFinite(pose.x)) this.view = { ...this.view, x: pose.x, y: pose.y };
    return this.view;
  }

  /** A place for something new: the middle of the view, or a free one beside it. */
  freePlace(reach: number): Point {
    const { x, y } = this.seen();
    for (let ring = 0; ring < 8; ring++)
      for (let turn = 0; turn < 8; turn++) {
        const angle = (turn * Math.PI) / 4;
        const away = ring * 2 * reach;
        const point = { x: x + Math.cos(angle) * away, y: y + Math.sin(angle) * away };
        if (!this.isTaken(point, reach)) return point;
        if (ring === 0) break;
      }
    return { x, y };
  }

  private isTaken(point: Point, reach: number): boolean {
    return this.standing().some(
      ({ thing, pose }) =>
        thing.kind !== 'patch' &&
        Math.hypot(pose.x - point.x, pose.y - point.y) < reach + reachOf(thing.shape),
    );
  }

  private moved(): void {
    this.order = null;
    this.drawn.emit();
  }

  private tell(): void {
    this.changed.emit();
    this.drawn.emit();
  }
}
