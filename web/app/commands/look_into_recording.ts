import type { Studio } from '../../core/studio';
import type { Path, Topics } from '../../protocol/messages';

/** How long a recording that is opened may take to come to its end. */
const kOpenMs = 60_000;

/** Runs a recorded run again; without an instant it is not looked back. */
export async function lookIntoRecording(
  studio: Studio,
  path: Path,
  t: number | undefined,
  opened = () => {},
): Promise<void> {
  const before = studio.topics.get('history', {})?.run;
  await studio.send('recording.open', { path });
  opened();
  if (t === undefined) return;
  // It is told from its beginning on, as fast as it is run again.
  const isThere = (is: Topics['history']['is']) => is.run !== before && is.to >= t;
  const known = await studio.topics.until('history', {}, isThere, kOpenMs);
  if (known && isThere(known)) studio.past.look(t);
}
