import type { Studio } from '../../core/studio';
import { toast } from '../../core/window_state';
import { collectFiles } from '../../core/zip_files';
import { text } from '../text';
import { download } from './download';
import { projectOf } from './looks';

/** Gives the project's files, as they are saved, to the browser as one zip. */
export async function exportZip(studio: Studio): Promise<void> {
  const files = (studio.topics.get('files', {})?.files ?? []).filter(
    (file) => file.kind !== 'folder',
  );
  const { contents, leftOut } = await collectFiles(
    files.map(({ path }) => path),
    async (path) => (await studio.send('file.bytes', { path })).base64,
  );
  // Loaded when it is first used: few ever export.
  const { zipSync } = await import('fflate');
  download(
    new Blob([new Uint8Array(zipSync(contents))], { type: 'application/zip' }),
    `${projectOf(studio)?.name ?? 'project'}.zip`,
  );
  toast(studio.window, 'ok', text.tree.exported(files.length - leftOut.length));
  if (leftOut.length > 0)
    toast(studio.window, 'warning', text.tree.leftOut(leftOut.map(({ path }) => path)));
}
