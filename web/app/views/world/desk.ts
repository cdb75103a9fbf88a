// The world that is looked at: forms and commands are about this one.

import { useCallback, useSyncExternalStore } from 'react';
import { Emitter } from '../../../core/emitter';
import type { JsonDocument } from '../../../core/json_document';
import type { Studio } from '../../../core/studio';
import type { WorldModel } from '../../../core/world/model';

export interface ShownWorld {
  model: WorldModel;
  /** The file that is edited; none of a run. */
  file: JsonDocument | null;
  /** Brings the keyboard to the picture. */
  focus(): void;
}

export class WorldDesk {
  readonly changed = new Emitter<void>();
  /** Someone works in a world. */
  readonly used = new Emitter<void>();
  version = 0;
  private readonly worlds: ShownWorld[] = [];
  private forms = 0;

  /** The last one that was looked at. */
  get shown(): ShownWorld | undefined {
    return this.worlds.at(-1);
  }

  /** There is a panel with the properties. */
  get hasForm(): boolean {
    return this.forms > 0;
  }

  add(world: ShownWorld): () => void {
    // Below those that are there: a view comes to the top when it is used.
    this.worlds.unshift(world);
    this.tell();
    return () => {
      this.worlds.splice(this.worlds.indexOf(world), 1);
      this.tell();
    };
  }

  use(world: ShownWorld): void {
    this.used.emit();
    const at = this.worlds.indexOf(world);
    if (this.shown === world || at < 0) return;
    this.worlds.splice(at, 1);
    this.worlds.push(world);
    this.tell();
  }

  addForm(): () => void {
    this.forms++;
    this.tell();
    return () => {
      this.forms--;
      this.tell();
    };
  }

  private tell(): void {
    this.version++;
    this.changed.emit();
  }
}

const desks = new WeakMap<Studio, WorldDesk>();

export function deskOf(studio: Studio): WorldDesk {
  const known = desks.get(studio);
  if (known) return known;
  const made = new WorldDesk();
  desks.set(studio, made);
  return made;
}

export function useDesk(studio: Studio): WorldDesk {
  const desk = deskOf(studio);
  useSyncExternalStore(
    useCallback((listener: () => void) => desk.changed.on(listener), [desk]),
    () => desk.version,
  );
  return desk;
}

export function useModel(model: WorldModel): WorldModel {
  useSyncExternalStore(
    useCallback((listener: () => void) => model.changed.on(listener), [model]),
    () => model.version,
  );
  return model;
}
