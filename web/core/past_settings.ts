// Values that variables of the plan are to have when a run goes on from an instant of the past:
// chosen while that instant is looked at, sent with `run.continue`.

import type { Commands, Json, PlanLevel } from '../protocol/messages';
import { Emitter } from './emitter';

export type PlanSetting = NonNullable<Commands['run.continue']['in']['set']>[number];

/** By the path of the plan and the name: where a plan stands among those inside of each other changes with the instant. */
export class PastSettings {
  readonly changed = new Emitter<void>();
  private readonly chosen = new Map<string, { path: string; name: string; value: Json }>();

  get(path: string, name: string): Json | undefined {
    return this.chosen.get(key(path, name))?.value;
  }

  /** undefined: it keeps the value that it had then. */
  set(path: string, name: string, value: Json | undefined): void {
    if (value === undefined) this.chosen.delete(key(path, name));
    else this.chosen.set(key(path, name), { path, name, value });
    this.changed.emit();
  }

  clear(): void {
    if (this.chosen.size === 0) return;
    this.chosen.clear();
    this.changed.emit();
  }

  /** What counts at an instant at which these plans are active. */
  of(levels: readonly PlanLevel[]): PlanSetting[] {
    const settings: PlanSetting[] = [];
    for (const { path, name, value } of this.chosen.values()) {
      const level = levels.findIndex((one) => one.path === path);
      if (levels[level]?.variables.some((one) => one.name === name))
        settings.push({ level, name, value });
    }
    return settings;
  }
}

const key = (path: string, name: string) => `${path} ${name}`;
