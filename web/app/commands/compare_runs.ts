import type { Studio } from '../../core/studio';
import { revealPanel } from '../../core/window_state';
import type { Path } from '../../protocol/messages';

/** The run that is shown beside that recording; which others, and where they are aligned, is chosen there. */
export async function compareRuns(studio: Studio, b: Path | null): Promise<void> {
  try {
    const { pairingOf } = await import('../../core/pairing');
    pairingOf(studio).choose({ a: null, b });
    revealPanel(studio.window, 'runs');
  } catch (problem) {
    studio.tell(problem);
  }
}
