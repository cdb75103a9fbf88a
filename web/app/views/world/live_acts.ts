// A hand in a running world: its moves become commands, one under way at a time, the newest place
// last; meanwhile the thing is where the hand holds it.

import type { Commands } from '../../../protocol/messages';
import type { Studio } from '../../../core/studio';
import type { Pose } from '../../../core/world/geometry';
import type { MoveBy, Placing, WorldActs, WorldModel } from '../../../core/world/model';
import { tidy } from '../../../core/world/snap';
import { keyOfObject, type Thing } from '../../../core/world/stage';

/** A frame of poses that was under way when the answer came still tells the old place. */
const kSettleMs = 120;

type Move = Commands['world.move']['in'];

export class LiveActs implements WorldActs {
  readonly edits = false;
  private next: { key: string; move: Move; done: boolean } | null = null;
  private sending = false;

  constructor(
    private readonly studio: Studio,
    private readonly model: WorldModel,
    readonly may: boolean,
  ) {}

  move(thing: Thing, pose: Pose, by: MoveBy): void {
    if (!this.may) return;
    this.model.hold(thing.key, pose);
    const at = [tidy(pose.x), tidy(pose.y)];
    this.next = {
      key: thing.key,
      move: { ...targetOf(thing), at, angle: tidy(pose.angle) },
      done: by !== 'holds',
    };
    void this.flush();
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
      ({ number }) => this.selectWhenThere(keyOfObject(number)),
      (problem: unknown) => this.studio.tell(problem),
    );
  }

  take(thing: Thing): void {
    const target = targetOf(thing);
    if (target.object !== undefined) this.studio.order('world.take', { object: target.object });
  }

  private async flush(): Promise<void> {
    if (this.sending) return;
    this.sending = true;
    while (this.next) {
      const { key, move, done } = this.next;
      this.next = null;
      try {
        await this.studio.send('world.move', move);
      } catch (problem) {
        this.studio.tell(problem);
      }
      if (done) this.studio.world.later(kSettleMs, () => !this.next && this.model.letGo(key));
    }
    this.sending = false;
  }

  /** The scene tells of it a moment later. */
  private selectWhenThere(key: string): void {
    if (this.model.thing(key)) return this.model.select(key);
    const off = this.model.changed.on(() => {
      if (!this.model.thing(key)) return;
      off();
      this.model.select(key);
    });
    this.studio.world.later(2000, off);
  }
}

export function targetOf(thing: Thing): { robot?: string; object?: number } {
  return thing.kind === 'robot'
    ? { robot: thing.name }
    : { object: Number(thing.key.slice(keyOfObject(0).length - 1)) };
}
