import type { Node } from '../../protocol/messages';
import { revealDoc } from '../../core/window_state';
import { useDrives, useStudio } from '../hooks';
import { text } from '../text';
import { Button } from './button';

/** Begins a script for a node that has none, and opens it. */
export function WriteScript({ node }: { node: Pick<Node, 'id' | 'name' | 'described'> }) {
  const studio = useStudio();
  const drives = useDrives();
  const write = async () => {
    const { doc } = await studio.send('script.add', { node: node.id });
    revealDoc(studio.window, doc, null);
  };
  return (
    <Button
      small
      disabled={!drives || !node.described}
      title={text.script.writeFor(node.name)}
      onClick={() => void write().catch((problem: unknown) => studio.tell(problem))}
    >
      {text.script.write}
    </Button>
  );
}
