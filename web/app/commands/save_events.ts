// Saves what happened as a file, also where nobody has looked at it yet.

import { kHappeningsLast, type Happenings } from '../../core/happenings';
import { happeningsCsv } from '../../core/happenings_csv';
import type { Studio } from '../../core/studio';
import { toast } from '../../core/window_state';
import type { Happening } from '../../protocol/messages';
import { text } from '../text';
import { download } from './download';

const kPatienceMs = 3000;
/** Those of before come so many at once. */
const kAtOnce = 1000;

export async function saveEvents(studio: Studio): Promise<void> {
  const items = await soonIn(studio.happenings);
  if (items.length === 0) toast(studio.window, 'note', text.whyNot.of['events.']);
  else download(new Blob([happeningsCsv(items)], { type: 'text/csv' }), 'events.csv');
}

/** Those of `happenings`, also where nobody has looked at them yet; none come where none happened. */
function soonIn(happenings: Happenings): Promise<readonly Happening[]> {
  return new Promise((done) => {
    const areAll = () => {
      const count = happenings.items.length;
      return count % kAtOnce > 0 || count >= kHappeningsLast;
    };
    const ready = () => {
      clearTimeout(patience);
      endChanges();
      endFollowing();
      done(happenings.items);
    };
    const patience = setTimeout(ready, kPatienceMs);
    const endChanges = happenings.changed.on(() => areAll() && ready());
    const endFollowing = happenings.follow();
    if (areAll()) ready();
  });
}
