import { pairingOf } from '../../../core/pairing';
import type { Studio } from '../../../core/studio';
import type { Path } from '../../../protocol/messages';
import { lookIntoRecording } from '../../commands/look_into_recording';

/** That instant of both; if one of them is the run that is shown, everything shows it. */
export function lookAtBoth(studio: Studio, t: number): void {
  const pairing = pairingOf(studio);
  const { asked, found } = pairing;
  pairing.look(t);
  if (!asked || !found) return;
  if (asked.a === null) studio.past.look(found.a.start + t);
  else if (asked.b === null) studio.past.look(found.b.start + t);
}

/** Everything shows that instant of one of them; null: of the run that is shown. */
export async function showOne(studio: Studio, path: Path | null, t: number): Promise<void> {
  try {
    if (path === null) studio.past.look(t);
    else await lookIntoRecording(studio, path, t);
  } catch (problem) {
    studio.tell(problem);
  }
}
