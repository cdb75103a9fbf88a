// Paths and documents of a project.

import type { Doc, Path } from '../protocol/messages';

/** carbot/carbot.aesl#2 is the script of the second node of the file. */
export function partOf(doc: Doc): { file: Path; part: number } {
  const match = /^(.*)#(\d+)$/s.exec(doc);
  return match ? { file: match[1] ?? doc, part: Number(match[2]) } : { file: doc, part: 0 };
}

export function baseName(path: Path): string {
  return path.slice(path.lastIndexOf('/') + 1);
}

export function folderOf(path: Path): Path {
  const cut = path.lastIndexOf('/');
  return cut < 0 ? '' : path.slice(0, cut);
}

export function joinPath(folder: Path, name: string): Path {
  return folder === '' ? name : `${folder}/${name}`;
}

/** The name as people say it: hall.world, not hall.world.json. */
export function shownName(path: Path): string {
  return baseName(path).replace(/\.(plan|world|toolbox)\.json$/, '.$1');
}

/** Why a file cannot have this name, or ''. */
export function badName(name: string): string {
  if (name === '' || name === '.' || name === '..') return 'Give it a name.';
  if (name.length > 200) return 'At most 200 characters.';
  if (!/^[\p{L}\p{N}_. -]+$/u.test(name)) return 'Letters, digits, space and . _ - only.';
  if (/^[. ]|[. ]$/.test(name)) return 'No dot or space at the beginning or end.';
  return '';
}

/** A recorded run. */
export function isRecording(path: Path): boolean {
  return path.endsWith('.mcap');
}

/** The trace of a plan's run, kept as a file. */
export function isTrace(path: Path): boolean {
  return path.endsWith('.trace.jsonl');
}

/** A test of behaviour. */
export function isTest(path: Path): boolean {
  return path.endsWith('.test.json');
}
