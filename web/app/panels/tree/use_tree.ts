// What the tree remembers and does.

import { useCallback, useMemo, useState } from 'react';
import type { Path } from '../../../protocol/messages';
import { openRecording, openTrace } from '../../commands/past_commands';
import { documentsIn } from '../../documents';
import { folderOf, isRecording, isTrace } from '../../../core/paths';
import type { Studio } from '../../../core/studio';
import type { TreeRow } from '../../../core/tree';
import { revealDoc, toast, update } from '../../../core/window_state';
import { useStudio } from '../../hooks';
import { text } from '../../text';

export interface TreeState {
  closed: ReadonlySet<Path>;
  chosen: Path | null;
  choose(path: Path): void;
  toggle(path: Path, open: boolean): void;
  closeAll(rows: readonly TreeRow[]): void;
  /** Where something new goes: the chosen folder, or the one of the chosen file. */
  folder(rows: readonly TreeRow[]): Path;
  open(row: TreeRow): void;
  /** Shows a document; the keyboard stays in the tree. */
  show(row: TreeRow): void;
  openText(row: TreeRow): void;
  rename(row: TreeRow): void;
  /** The file that is to be deleted, once that is confirmed. */
  asked: Path | null;
  ask(row: TreeRow): void;
  keep(): void;
  remove(row: TreeRow): Promise<void>;
}

export function useTree(): TreeState {
  const studio = useStudio();
  const [closed, setClosed] = useState<ReadonlySet<Path>>(new Set());
  const [chosen, choose] = useState<Path | null>(null);
  const [asked, setAsked] = useState<Path | null>(null);
  const toggle = useCallback((path: Path, open: boolean) => {
    setClosed((before) => {
      const next = new Set(before);
      if (open) next.delete(path);
      else next.add(path);
      return next;
    });
  }, []);
  return useMemo(
    () => ({
      ...openings(studio, toggle),
      closed,
      chosen,
      choose,
      toggle,
      closeAll: (rows) =>
        setClosed(new Set(rows.filter((row) => row.kind === 'folder').map((row) => row.path))),
      folder: (rows) => {
        const row = rows.find((one) => one.path === chosen);
        return row
          ? row.kind === 'folder'
            ? row.path
            : folderOf(row.path)
          : folderOf(outermost(rows)?.path ?? '');
      },
      openText: (row) => revealDoc(studio.window, row.path, null),
      rename: (row) => update(studio.window, (draft) => void (draft.naming = { rename: row.path })),
      asked,
      ask: (row) => setAsked(row.path),
      keep: () => setAsked(null),
      remove: async (row) => {
        setAsked(null);
        await studio.send('file.delete', { path: row.path });
        toast(studio.window, 'note', text.tree.remove(row.name));
      },
    }),
    [studio, closed, chosen, asked, toggle],
  );
}

function openings(studio: Studio, toggle: TreeState['toggle']): Pick<TreeState, 'open' | 'show'> {
  const open = (row: TreeRow, takesFocus: boolean) => {
    if (row.kind === 'folder') return toggle(row.path, !row.open);
    if (isRecording(row.path)) return void openRecording(studio, row.path);
    if (isTrace(row.path)) return void openTrace(studio, row.path);
    for (const doc of documentsIn(studio, row.path).reverse())
      revealDoc(studio.window, doc, null, takesFocus);
  };
  return { open: (row) => open(row, true), show: (row) => open(row, false) };
}

/** Of the project that is open: those of projects inside of it lie deeper. */
function outermost(rows: readonly TreeRow[]): TreeRow | undefined {
  return rows
    .filter((row) => row.kind === 'project')
    .reduce<TreeRow | undefined>(
      (best, row) => (best && best.level <= row.level ? best : row),
      undefined,
    );
}
