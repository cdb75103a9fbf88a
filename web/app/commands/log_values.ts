import type { LogPlace } from '../../core/logs';
import type { Studio } from '../../core/studio';
import { revealPanel, toast } from '../../core/window_state';

/** A run that is recorded, or was: it can be run again for what its variables held. */
export const canLog = ({ past, topics }: Studio): boolean =>
  past.trace === null && past.end > past.start && topics.get('history', {})?.kind === 'simulated';

/** A log point at that place of the run that is shown; what it shows is typed next. */
export async function logAt(studio: Studio, place: LogPlace): Promise<void> {
  try {
    const { kLogPointsMax, logsOf } = await import('../../core/logs');
    if (!logsOf(studio).add(place))
      toast(studio.window, 'warning', `There are ${kLogPointsMax} log points: remove one first.`);
    revealPanel(studio.window, 'logs');
  } catch (problem) {
    studio.tell(problem);
  }
}
