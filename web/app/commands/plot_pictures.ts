// The plot as a picture, into the clipboard or a file.

import type { Studio } from '../../core/studio';
import { toast } from '../../core/window_state';
import { text } from '../text';
import { download } from './download';
import { plotPicture } from './plot_handles';

export async function copyPng(studio: Studio): Promise<void> {
  const picture = await plotPicture(studio);
  if (!picture) return;
  if (typeof ClipboardItem === 'undefined') throw new Error(text.clipboard.noClipboard);
  await clipboard().write([new ClipboardItem({ [picture.type]: picture })]);
  toast(studio.window, 'ok', text.clipboard.copied('PNG'));
}

/** A page that came over an open line has none. */
function clipboard(): Clipboard {
  const { clipboard: own } = navigator as { clipboard?: Clipboard };
  if (!own) throw new Error(text.clipboard.noClipboard);
  return own;
}

export async function savePng(studio: Studio): Promise<void> {
  const picture = await plotPicture(studio);
  if (picture) download(picture, 'plot.png');
}
