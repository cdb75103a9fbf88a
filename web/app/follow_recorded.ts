import type { Studio } from '../core/studio';
import { projectOf } from './commands/looks';
import { openRecording } from './commands/past_commands';

/** A recording that a project was made of is shown as soon as the project is open. */
export function followRecorded(studio: Studio): void {
  let shown: string | null = null; // the folder of its project
  studio.topics.subscribe('studio', {}, () => {
    const project = projectOf(studio);
    if (!project?.recording || project.folder === shown || !studio.drives) return;
    shown = project.folder;
    void openRecording(studio, project.recording);
  });
}
