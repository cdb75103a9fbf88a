import { Menu } from '@mantine/core';
import { IconDots } from '@tabler/icons-react';
import { isTest } from '../../../core/paths';
import type { TreeRow } from '../../../core/tree';
import { revealDoc } from '../../../core/window_state';
import { copyText } from '../../commands/clipboard';
import { documentsIn } from '../../documents';
import { useDrives, useStudio } from '../../hooks';
import { kStroke } from '../../parts/icons';
import { Kbd } from '../../parts/kbd';
import { StudioMenu, WhyItem } from '../../parts/menu';
import { text } from '../../text';
import type { TreeState } from './use_tree';

interface Props {
  row: TreeRow;
  tree: TreeState;
  open: boolean;
  onChange(open: boolean): void;
}

/** What can be done with a file; its button shows with the pointer or the focus. */
export function TreeMenu({ row, tree, open, onChange }: Props) {
  const studio = useStudio();
  const why = useDrives() ? '' : text.whyNot.viewOnly;
  const isFile = row.kind !== 'folder';
  const button = (
    <button
      type="button"
      className="tree__menu"
      tabIndex={-1}
      aria-label={`${row.name}: ${text.menu.more}`}
      onClick={(event) => event.stopPropagation()}
    >
      <IconDots size={14} stroke={kStroke} aria-hidden />
    </button>
  );
  const beside = () =>
    documentsIn(studio, row.path)
      .slice(0, 1)
      .forEach((doc) => revealDoc(studio.window, doc, null, true, true));
  const test = isTest(row.path) ? studio.registry.find('tests.run') : undefined;
  const runTest = () => {
    revealDoc(studio.window, row.path, null);
    studio.registry.run('tests.run');
  };
  const copy = () =>
    void copyText(studio, row.path, text.tree.copied(row.path)).catch((problem: unknown) =>
      studio.tell(problem),
    );
  return (
    <span onClick={(event) => event.stopPropagation()} className="tree__end">
      <StudioMenu button={button} position="bottom-end" opened={open} onChange={onChange}>
        {test ? (
          <WhyItem why={why} onClick={runTest}>
            {test.title}
          </WhyItem>
        ) : null}
        {row.path.endsWith('.mcap') ? (
          <Menu.Item
            onClick={() =>
              void import('../../commands/compare_runs').then(({ compareRuns }) =>
                compareRuns(studio, row.path),
              )
            }
          >
            {text.tree.compare}
          </Menu.Item>
        ) : null}
        {isFile ? <Menu.Item onClick={beside}>{text.commands['view.side']}</Menu.Item> : null}
        {row.kind === 'script' ? (
          <Menu.Item onClick={() => tree.openText(row)}>{text.tree.openText}</Menu.Item>
        ) : null}
        <WhyItem why={why} rightSection={<Kbd keys="F2" />} onClick={() => tree.rename(row)}>
          {text.tree.rename}
        </WhyItem>
        <WhyItem why={why} rightSection={<Kbd keys="Del" />} onClick={() => tree.ask(row)}>
          {text.tree.delete}
        </WhyItem>
        <Menu.Item onClick={copy}>{text.tree.copyPath}</Menu.Item>
      </StudioMenu>
    </span>
  );
}
