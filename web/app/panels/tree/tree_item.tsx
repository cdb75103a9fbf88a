import { IconChevronDown, IconChevronRight } from '@tabler/icons-react';
import { useState } from 'react';
import { isRecording, isTrace, partOf, shownName } from '../../../core/paths';
import type { TreeRow } from '../../../core/tree';
import { useDrives, useTopic, useWindow } from '../../hooks';
import { FileIcon, kStroke } from '../../parts/icons';
import { Marks, marksOf, SavedMark } from '../../parts/marks';
import { DeleteAsk } from './delete_ask';
import { NameInput } from './name_input';
import { TreeMenu } from './tree_menu';
import type { TreeState } from './use_tree';

interface Props {
  row: TreeRow;
  tree: TreeState;
  /** Tab stops here; arrows lead on. */
  tabbed: boolean;
  onKey(key: string): boolean;
}

export function TreeItem({ row, tree, tabbed, onKey }: Props) {
  const drives = useDrives();
  const naming = useWindow((state) => state.naming);
  const shown = useWindow((state) => state.doc !== null && partOf(state.doc).file === row.path);
  const [menu, setMenu] = useState(false);
  if (naming && 'rename' in naming && naming.rename === row.path)
    return <NameInput folder="" kind="text" rename={row.path} />;
  if (tree.asked === row.path) return <DeleteAsk row={row} tree={tree} />;
  const press = (event: React.KeyboardEvent) => {
    if (event.target !== event.currentTarget) return;
    if (event.key === 'Enter' || event.key === ' ') tree.open(row);
    else if (event.key === 'ArrowLeft' && row.open) tree.toggle(row.path, false);
    else if (event.key === 'ArrowRight' && row.kind === 'folder' && !row.open)
      tree.toggle(row.path, true);
    else if (event.key === 'F2' && drives) tree.rename(row);
    else if (event.key === 'Delete' && drives) tree.ask(row);
    else if (event.key === 'ContextMenu' || (event.key === 'F10' && event.shiftKey)) setMenu(true);
    else if (!onKey(event.key)) return;
    event.preventDefault();
    event.stopPropagation();
  };
  return (
    <li
      className={shown ? 'row tree__row is-on' : 'row tree__row'}
      role="treeitem"
      data-path={row.path}
      data-level={Math.min(row.level, 8)}
      aria-level={row.level}
      aria-posinset={row.position}
      aria-setsize={row.siblings}
      aria-expanded={row.kind === 'folder' ? row.open : undefined}
      aria-selected={shown}
      tabIndex={tabbed ? 0 : -1}
      onFocus={() => tree.choose(row.path)}
      // F2 and Delete after a click mean the file, not what is chosen in it.
      onClick={() => tree.show(row)}
      onDoubleClick={() => hasText(row) && tree.open(row)}
      onContextMenu={(event) => (event.preventDefault(), setMenu(true))}
      onKeyDown={press}
    >
      {row.kind === 'folder' ? <Chevron open={row.open} /> : <span className="tree__space" />}
      <FileIcon kind={row.kind} open={row.open} />
      <span className="ellipsis">{shownName(row.path)}</span>
      <span className="grow" />
      <FileMarks row={row} />
      <TreeMenu row={row} tree={tree} open={menu} onChange={setMenu} />
    </li>
  );
}

/** What a second click does not open again, or close. */
function hasText({ kind, path }: TreeRow): boolean {
  return kind !== 'folder' && !isRecording(path) && !isTrace(path);
}

function Chevron({ open }: { open: boolean }) {
  const Icon = open ? IconChevronDown : IconChevronRight;
  return <Icon className="icon tree__chevron" size={12} stroke={kStroke} aria-hidden />;
}

/** A file of scripts has the worst marks of its nodes. */
function FileMarks({ row }: { row: TreeRow }) {
  const parts = useTopic('scripts', {})?.parts.filter((part) => part.file === row.path) ?? [];
  const nodes = useTopic('robot', {})?.nodes ?? [];
  if (row.kind === 'folder') return null;
  const own = parts
    .map((part) => nodes.find((node) => node.doc === part.doc))
    .filter((node) => node !== undefined);
  if (own.length === 0) return row.unsaved ? <SavedMark saved={false} /> : null;
  const worst =
    own.find((node) => node.program === 'older') ??
    own.find((node) => node.program !== 'current') ??
    own[0];
  return <Marks {...marksOf(row.unsaved, worst)} />;
}
