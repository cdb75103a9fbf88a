import type { Studio } from '../../core/studio';
import { toast } from '../../core/window_state';
import { text } from '../text';
import { download } from './download';
import { projectOf } from './looks';

/** Gives the project's files, as they are saved, to the browser as one zip. */
export async function exportZip(studio: Studio): Promise<void> {
  const files = (studio.topics.get('files', {})?.files ?? []).filter(
    (file) => file.kind !== 'folder',
  );
  const contents: Record<string, Uint8Array> = {};
  for (const { path } of files) {
    const { base64 } = await studio.send('file.bytes', { path });
    contents[path] = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  }
  // Loaded when it is first used: few ever export.
  const { zipSync } = await import('fflate');
  download(
    new Blob([new Uint8Array(zipSync(contents))], { type: 'application/zip' }),
    `${projectOf(studio)?.name ?? 'project'}.zip`,
  );
  toast(studio.window, 'ok', text.tree.exported(files.length));
}
