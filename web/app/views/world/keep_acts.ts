// What was done by hand in a run: undone, done again, and kept in the file of the world.

import type { JsonFile } from '../../../core/session/json_file';
import type { Studio } from '../../../core/studio';
import { toast } from '../../../core/window_state';
import { keepSteps } from '../../../core/world/keep';
import { projectOf } from '../../commands/looks';
import { text } from '../../text';

const words = text.world;

export function undoInRun(studio: Studio): void {
  if (studio.hand.canUndo) void studio.hand.undo();
  else toast(studio.window, 'note', words.nothingToUndo);
}

export function redoInRun(studio: Studio): void {
  if (studio.hand.canRedo) void studio.hand.redo();
  else toast(studio.window, 'note', words.nothingToRedo);
}

/** So many things the file does not have as a hand left them. */
export function countToKeep(studio: Studio, file: JsonFile): number {
  return keepSteps(file.value, studio.hand.changes()).kept.size;
}

/** All of it, in one step of the file. */
export async function keepInWorld(studio: Studio): Promise<void> {
  const project = projectOf(studio);
  if (project?.world === undefined) return;
  const held = studio.documents.acquire(project.world);
  try {
    const file = (await held.opened).file();
    const { steps, kept } = keepSteps(file.value, studio.hand.changes());
    if (!file.commit(steps)) return toast(studio.window, 'error', words.cannotKeep);
    // The run shows it already: that the file is another one by now is no news.
    studio.hand.keep(kept, project.world_changed ? null : file.session.text);
    toast(studio.window, 'note', words.kept(kept.size, project.world.split('/').at(-1) ?? ''));
  } finally {
    held.release();
  }
}
