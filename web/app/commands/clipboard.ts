// Text for the clipboard. A page that came over an open line has none of its own: the older way is left.

import type { Studio } from '../../core/studio';
import { toast } from '../../core/window_state';
import { text } from '../text';

/** Copies, and says that it has. */
export async function copyText(studio: Studio, copied: string, said: string): Promise<void> {
  const { clipboard } = navigator as { clipboard?: Clipboard };
  if (clipboard) await clipboard.writeText(copied);
  else if (!copySelected(copied)) throw new Error(text.clipboard.noClipboard);
  toast(studio.window, 'ok', said);
}

/** By a field that is selected for a moment. */
function copySelected(copied: string): boolean {
  const before = document.activeElement;
  const field = document.createElement('textarea');
  field.value = copied;
  field.readOnly = true;
  field.className = 'hidden-text';
  document.body.append(field);
  field.select();
  // The only way without https; browsers keep it for that.
  const done = document.execCommand('copy');
  field.remove();
  if (before instanceof HTMLElement) before.focus();
  return done;
}
