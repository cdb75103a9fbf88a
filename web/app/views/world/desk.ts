// The worlds that are looked at: forms and commands are about the one that was used last.

import { Desk, deskFor } from '../../../core/desk';
import type { JsonFile } from '../../../core/session/json_file';
import type { Studio } from '../../../core/studio';
import type { WorldModel } from '../../../core/world/model';
import { useChanges } from '../../hooks';

export interface ShownWorld {
  model: WorldModel;
  /** The file that is edited; none of a run. */
  file: JsonFile | null;
  /** Brings the keyboard to the picture. */
  focus(): void;
}

export class WorldDesk extends Desk<ShownWorld> {
  private forms = 0;

  /** There is a panel with the properties. */
  get hasForm(): boolean {
    return this.forms > 0;
  }

  addForm(): () => void {
    this.forms++;
    this.changed.emit();
    return () => {
      this.forms--;
      this.changed.emit();
    };
  }
}

export const deskOf: (studio: Studio) => WorldDesk = deskFor(() => new WorldDesk());

export function useDesk(studio: Studio): WorldDesk {
  const desk = deskOf(studio);
  useChanges(desk.changed);
  return desk;
}

export function useModel(model: WorldModel): WorldModel {
  useChanges(model.changed);
  return model;
}
