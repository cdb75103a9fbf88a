import { zipSync } from 'fflate';
import type { Studio } from '../../core/studio';
import { toast } from '../../core/window_state';
import { collectFiles } from '../../core/zip_files';
import { counted } from '../text';
import { download } from './download';
import { projectOf } from './looks';

const words = {
  exported: (count: number) => `${counted(count, 'file', 'files')} exported.`,
  leftOut: (paths: readonly string[]) =>
    `Left out, because larger than 4 MiB or not readable: ${paths.slice(0, 5).join(', ')}${paths.length > 5 ? ` and ${paths.length - 5} more` : ''}. Copy them from the folder of the project.`,
};

/** Gives the project's files, as they are saved, to the browser as one zip. */
export async function exportZip(studio: Studio): Promise<void> {
  const files = (studio.topics.get('files', {})?.files ?? []).filter(
    (file) => file.kind !== 'folder',
  );
  const { contents, leftOut } = await collectFiles(
    files.map(({ path }) => path),
    async (path) => (await studio.send('file.bytes', { path })).base64,
  );
  download(
    new Blob([new Uint8Array(zipSync(contents))], { type: 'application/zip' }),
    `${projectOf(studio)?.name ?? 'project'}.zip`,
  );
  toast(studio.window, 'ok', words.exported(files.length - leftOut.length));
  if (leftOut.length > 0)
    toast(studio.window, 'warning', words.leftOut(leftOut.map(({ path }) => path)));
}
