import { IconPlus, IconFold } from '@tabler/icons-react';
import { Menu } from '@mantine/core';
import { useRef } from 'react';
import { treeRows, type TreeRow } from '../../../core/tree';
import { useDrives, useStudio, useTopic, useWindow } from '../../hooks';
import { Quiet } from '../../parts/blank';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { CommandItem, StudioMenu } from '../../parts/menu';
import { text } from '../../text';
import { NameInput } from './name_input';
import { TreeItem } from './tree_item';
import { useTree } from './use_tree';

/** The project's files, by keyboard as a tree should: arrows, Enter, F2, Delete. */
export function FileTree() {
  const files = useTopic('files', {});
  const naming = useWindow((state) => state.naming);
  const tree = useTree();
  const list = useRef<HTMLUListElement>(null);
  const rows = treeRows(files?.files ?? [], tree.closed);
  const current = rows.some((row) => row.path === tree.chosen) ? tree.chosen : rows[0]?.path;
  const focus = (path: string) =>
    list.current?.querySelector<HTMLElement>(`[data-path="${CSS.escape(path)}"]`)?.focus();
  return (
    <section aria-label={text.tree.label}>
      <TreeHead
        name={useTopic('studio', {})?.project?.name ?? ''}
        onCollapse={() => tree.closeAll(rows)}
      />
      {naming && !('rename' in naming) ? (
        <NameInput folder={tree.folder(rows)} kind={naming.kind} />
      ) : null}
      <ul className="tree" role="tree" aria-label={text.tree.label} ref={list}>
        {rows.map((row) => (
          <TreeItem
            key={row.path}
            row={row}
            tree={tree}
            tabbed={row.path === current}
            onKey={(key) => {
              const next = keyTarget(rows, row, key);
              if (next) focus(next.path);
              return next !== undefined;
            }}
          />
        ))}
      </ul>
      {files && rows.length === 0 ? <Quiet>{text.empty.files}</Quiet> : null}
      {files?.more ? <Quiet>{text.tree.more}</Quiet> : null}
    </section>
  );
}

/** Where an arrow goes from a row; undefined if it is no arrow or the row itself has to act. */
function keyTarget(rows: TreeRow[], row: TreeRow, key: string): TreeRow | undefined {
  const at = rows.indexOf(row);
  switch (key) {
    case 'ArrowDown':
      return rows[Math.min(at + 1, rows.length - 1)];
    case 'ArrowUp':
      return rows[Math.max(at - 1, 0)];
    case 'Home':
      return rows[0];
    case 'End':
      return rows.at(-1);
    case 'ArrowLeft':
      return row.open ? undefined : rows.slice(0, at).findLast((one) => one.level < row.level);
    case 'ArrowRight':
      return row.open ? rows[at + 1] : undefined;
    default:
      return undefined;
  }
}

function TreeHead({ name, onCollapse }: { name: string; onCollapse(): void }) {
  const drives = useDrives();
  const { registry } = useStudio();
  const add = (
    <Button
      kind="plain"
      small
      disabled={!drives}
      aria-label={text.tree.new}
      title={text.tree.new}
      icon={<IconPlus size={14} stroke={kStroke} />}
    />
  );
  return (
    <div className="group group--top">
      <span className="group__title ellipsis">{name}</span>
      <StudioMenu button={add} position="bottom-end">
        {(['script', 'plan', 'world', 'toolbox', 'text', 'folder'] as const).map((kind) => (
          <Menu.Item key={kind} onClick={() => registry.run(`file.new.${kind}`)}>
            {text.tree.kinds[kind]}
          </Menu.Item>
        ))}
        <Menu.Divider />
        <CommandItem id="file.export" />
      </StudioMenu>
      <Button
        kind="plain"
        small
        tip={text.tree.collapse}
        icon={<IconFold size={14} stroke={kStroke} />}
        onClick={onCollapse}
      />
    </div>
  );
}
