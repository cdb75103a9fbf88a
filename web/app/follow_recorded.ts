import type { Studio } from '../core/studio';
import { projectOf } from './commands/looks';
import { openRecording } from './commands/past_commands';

const kKey = 'vagus.recorded';

/** What this page shows without a run, and where. */
interface Shown {
  folder: string; // of its project
  path: string;
  robot: string | undefined;
  at: number | undefined;
}

/**
 * A recording that a project was made of is shown as soon as the project is open; one that is shown
 * without a run is shown again, at the same instant, when the page was loaded again.
 */
export function followRecorded(studio: Studio): void {
  let again = takeShown();
  addEventListener('pagehide', () => keepShown(studio));
  let folder: string | null = null;
  studio.topics.subscribe('studio', {}, () => {
    const project = projectOf(studio);
    if (!project || project.folder === folder) return;
    const before = again?.folder === project.folder ? again : null;
    again = null;
    if (before) {
      folder = project.folder;
      void show(studio, before);
    } else if (project.recording && studio.drives) {
      folder = project.folder;
      void openRecording(studio, project.recording);
    }
  });
}

async function show(studio: Studio, { path, robot, at }: Shown): Promise<void> {
  try {
    await studio.past.openTrace(path, robot, at);
  } catch (problem) {
    studio.tell(problem);
  }
}

function keepShown(studio: Studio): void {
  const { trace, at } = studio.past;
  const folder = projectOf(studio)?.folder;
  if (!trace || folder === undefined) return;
  const shown: Shown = { folder, path: trace.path, robot: trace.robot, at: at ?? undefined };
  sessionStorage.setItem(kKey, JSON.stringify(shown));
}

/** A tab that is duplicated shows what is now. */
function takeShown(): Shown | null {
  const text = sessionStorage.getItem(kKey);
  sessionStorage.removeItem(kKey);
  // Only this page writes it.
  return text === null ? null : (JSON.parse(text) as Shown);
}
