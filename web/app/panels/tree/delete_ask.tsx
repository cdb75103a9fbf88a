import type { TreeRow } from '../../../core/tree';
import { useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { text } from '../../text';
import type { TreeState } from './use_tree';

/** In the place of its row: a file is deleted only when that is confirmed. */
export function DeleteAsk({ row, tree }: { row: TreeRow; tree: TreeState }) {
  const studio = useStudio();
  return (
    <li
      className="tree__ask"
      role="treeitem"
      aria-selected={false}
      aria-level={row.level}
      onKeyDown={(event) => event.key === 'Escape' && (event.stopPropagation(), tree.keep())}
    >
      <span className="ellipsis">{text.tree.ask(row.name)}</span>
      <span className="grow" />
      <Button
        small
        autoFocus
        onClick={() => void tree.remove(row).catch((problem: unknown) => studio.tell(problem))}
      >
        {text.tree.delete}
      </Button>
      <Button small kind="plain" onClick={tree.keep}>
        {text.tree.keepIt}
      </Button>
    </li>
  );
}
