// A hand in the file of a world: what it does are steps, saved when the file is.

import type { JsonFile } from '../../../core/session/json_file';
import { moveSteps, newObject, newRobot, removeSteps } from '../../../core/world/file';
import type { Pose } from '../../../core/world/geometry';
import type { MoveBy, Placing, WorldActs, WorldModel } from '../../../core/world/model';
import type { Thing } from '../../../core/world/stage';

export class FileActs implements WorldActs {
  readonly edits = true;

  constructor(
    private readonly file: JsonFile,
    private readonly model: WorldModel,
    readonly may: boolean,
    private readonly now: () => number,
  ) {}

  move(thing: Thing, pose: Pose, by: MoveBy): void {
    if (!this.may) return;
    if (by === 'holds') return this.model.hold(thing.key, pose);
    const row = by === 'key' ? { of: `keys ${thing.key}`, at: this.now() } : undefined;
    this.file.commit(moveSteps(this.file.value, thing.key, pose), row);
    this.model.letGo(thing.key);
  }

  put(placing: Placing): void {
    const { steps, key } =
      placing.what === 'robot'
        ? newRobot(this.file.value, placing.type, placing.at)
        : newObject(this.file.value, placing.kind, placing.at);
    this.file.commit(steps);
    this.model.select(key);
  }

  take(thing: Thing): void {
    this.file.commit(removeSteps(this.file.value, thing.key));
    this.model.select(null);
  }
}
