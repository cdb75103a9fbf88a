// The project's files as a tree, and as the rows that are seen of it.

import type { FileEntry, Path } from '../protocol/messages';
import { baseName, folderOf } from './paths';

export interface TreeRow {
  path: Path;
  name: string;
  level: number;
  kind: FileEntry['kind'];
  unsaved: boolean;
  open: boolean;
  /** Place among its neighbours and their number, for those who hear the tree. */
  position: number;
  siblings: number;
}

/** The rows that are seen: folders first, by name, closed ones without what is in them. */
export function treeRows(files: readonly FileEntry[], closed: ReadonlySet<Path>): TreeRow[] {
  const children = childrenOf(files);
  const rows: TreeRow[] = [];
  const visit = (folder: Path, level: number) => {
    const list = children.get(folder) ?? [];
    list.forEach((entry, index) => {
      const open = entry.kind === 'folder' && !closed.has(entry.path);
      rows.push({
        path: entry.path,
        name: baseName(entry.path),
        level,
        kind: entry.kind,
        unsaved: entry.unsaved,
        open,
        position: index + 1,
        siblings: list.length,
      });
      if (open) visit(entry.path, level + 1);
    });
  };
  visit('', 1);
  return rows;
}

function childrenOf(files: readonly FileEntry[]): Map<Path, FileEntry[]> {
  const children = new Map<Path, FileEntry[]>();
  const add = (entry: FileEntry) => {
    const list = children.get(folderOf(entry.path));
    if (list) list.push(entry);
    else children.set(folderOf(entry.path), [entry]);
  };
  const known = new Set(files.map((file) => file.path));
  for (const file of files) {
    add(file);
    // A folder that is not listed by itself is still shown.
    for (let up = folderOf(file.path); up !== '' && !known.has(up); up = folderOf(up)) {
      known.add(up);
      add({ path: up, kind: 'folder', size: 0, unsaved: false });
    }
  }
  for (const list of children.values()) list.sort(byKindAndName);
  return children;
}

function byKindAndName(a: FileEntry, b: FileEntry): number {
  const folders = Number(b.kind === 'folder') - Number(a.kind === 'folder');
  return folders || baseName(a.path).localeCompare(baseName(b.path), 'en');
}
