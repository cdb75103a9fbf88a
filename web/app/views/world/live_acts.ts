// A hand in a running world: its moves become commands, one under way at a time, the newest place
// last; meanwhile the thing stands where the hand holds it, in the run, too: a robot that drives on
// is put back. What was done is noted, so that it can be undone and kept.

import type { Commands, SceneObject } from '../../../protocol/messages';
import type { Studio } from '../../../core/studio';
import { distance, normalAngle, type Pose } from '../../../core/world/geometry';
import type { HandObject } from '../../../core/world/hand';
import type { MoveBy, Placing, WorldActs, WorldModel } from '../../../core/world/model';
import { tidy } from '../../../core/world/snap';
import { keyOfObject, type Thing } from '../../../core/world/stage';

/** A frame of poses that was under way when the answer came still tells the old place. */
const kSettleMs = 120;
/** What is held and is farther from the hand than this is put back, in m and rad. */
const kSlipM = 0.0005;
const kSlipAngle = 0.002;

type Move = Commands['world.move']['in'];

/** From the first move of a thing until the hand lets it go. */
interface Grip {
  thing: Thing;
  from: Pose;
  to: Pose;
  row: string | null;
}

export class LiveActs implements WorldActs {
  readonly edits = false;
  private grip: Grip | null = null;
  private readonly next: { grip: Grip; pose: Pose; done: boolean }[] = [];
  private sending = false;

  constructor(
    private readonly studio: Studio,
    private readonly model: WorldModel,
    readonly may: boolean,
    private readonly now: () => number,
  ) {}

  move(thing: Thing, pose: Pose, by: MoveBy): void {
    if (!this.may) return;
    const held = this.grip?.thing.key === thing.key ? this.grip : null;
    const from = this.model.poseOf(thing);
    const row = by === 'key' ? `keys ${thing.key}` : null;
    const grip = held ?? { thing, from, to: from, row };
    this.grip = by === 'holds' ? grip : null;
    this.model.hold(thing.key, pose);
    this.ask(grip, pose, by !== 'holds');
  }

  again(): void {
    const { grip, model } = this;
    if (!grip || this.next.length > 0) return;
    const is = model.poseInRun(grip.thing);
    const held = model.poseOf(grip.thing);
    if (!is) return;
    const slips = distance(is, held) > kSlipM;
    if (slips || Math.abs(normalAngle(is.angle - held.angle)) > kSlipAngle)
      this.ask(grip, held, false);
  }

  put({ at, ...placing }: Placing): void {
    if (placing.what !== 'object') return;
    const { kind } = placing;
    if (kind !== 'wall' && kind !== 'box' && kind !== 'cylinder') return;
    const input: Commands['world.put']['in'] = { kind, at: [tidy(at.x), tidy(at.y)] };
    if (at.angle !== 0) input.angle = tidy(at.angle);
    if (kind === 'cylinder') input.radius = 0.1;
    else input.size = kind === 'wall' ? [0.5, 0.05] : [0.2, 0.2];
    this.studio.send('world.put', input).then(
      ({ number }) =>
        this.whenThere(keyOfObject(number), (thing) => {
          this.model.select(thing.key);
          const object = this.objectOf(thing, at);
          if (object) this.studio.hand.note({ is: 'put', number, object });
        }),
      (problem: unknown) => this.studio.tell(problem),
    );
  }

  take(thing: Thing): void {
    const { object: number } = targetOf(thing);
    const object = this.objectOf(thing, this.model.poseOf(thing));
    if (number === undefined || !object) return;
    this.studio.send('world.take', { object: number }).then(
      () => this.studio.hand.note({ is: 'take', number, object }),
      (problem: unknown) => this.studio.tell(problem),
    );
  }

  light(thing: Thing, on: boolean): void {
    const { object: number } = targetOf(thing);
    const object = this.objectOf(thing, this.model.poseOf(thing));
    if (number === undefined || !object) return;
    this.studio.send('world.light', { object: number, on }).then(
      () => this.studio.hand.note({ is: 'light', number, object, on }),
      (problem: unknown) => this.studio.tell(problem),
    );
  }

  /** The newest place of a thing stands for all before it; letting go is never left out. */
  private ask(grip: Grip, pose: Pose, done: boolean): void {
    const last = this.next.at(-1);
    if (last && last.grip === grip && !last.done) this.next.pop();
    this.next.push({ grip, pose, done });
    void this.flush();
  }

  private async flush(): Promise<void> {
    if (this.sending) return;
    this.sending = true;
    for (let one = this.next.shift(); one; one = this.next.shift()) {
      const { grip, pose, done } = one;
      const at = [tidy(pose.x), tidy(pose.y)];
      const move: Move = { ...targetOf(grip.thing), at, angle: tidy(pose.angle) };
      try {
        await this.studio.send('world.move', move);
        grip.to = pose;
      } catch (problem) {
        // Of what is held the next place may be a good one; it is said once, when it is let go.
        if (done) this.studio.tell(problem);
      }
      if (done) this.end(grip);
    }
    this.sending = false;
  }

  private end(grip: Grip): void {
    const { thing, from, to, row } = grip;
    this.studio.world.later(kSettleMs, () => {
      const held = this.grip?.thing.key === thing.key;
      const asked = this.next.some((one) => one.grip.thing.key === thing.key);
      if (!held && !asked) this.model.letGo(thing.key);
    });
    if (to === from) return;
    const at = row === null ? null : { of: row, at: this.now() };
    const { robot, object: number } = targetOf(thing);
    const object = this.objectOf(thing, from);
    if (robot !== undefined) this.studio.hand.note({ is: 'robot', name: robot, from, to }, at);
    else if (number !== undefined && object)
      this.studio.hand.note({ is: 'move', number, object, to }, at);
  }

  /** As the scene tells it. */
  private objectOf(thing: Thing, pose: Pose): HandObject | null {
    const objects: readonly SceneObject[] = this.studio.topics.get('scene', {})?.objects ?? [];
    const { object: number } = targetOf(thing);
    const found = objects.find((one) => one.number === number);
    if (!found) return null;
    const { number: _, ...object } = found;
    return { ...object, pose };
  }

  /** The scene tells of it a moment later. */
  private whenThere(key: string, act: (thing: Thing) => void): void {
    const there = this.model.thing(key);
    if (there) return act(there);
    const off = this.model.changed.on(() => {
      const thing = this.model.thing(key);
      if (!thing) return;
      off();
      act(thing);
    });
    this.studio.world.later(2000, off);
  }
}

export function targetOf(thing: Thing): { robot?: string; object?: number } {
  return thing.kind === 'robot'
    ? { robot: thing.name }
    : { object: Number(thing.key.slice(keyOfObject(0).length - 1)) };
}
