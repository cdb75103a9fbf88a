import type { Node } from '../../../protocol/messages';
import { heldWords } from './words';

const words = heldWords;

/** Nodes that are paused at a line of their script, and how many events they have dropped there. */
export function DroppedByNodes({ nodes }: { nodes: readonly Node[] }) {
  const standing = nodes.filter((node) => node.state === 'paused' && node.at !== undefined);
  if (standing.length === 0) return null;
  return (
    <ul aria-label={words.droppedByNodes}>
      {standing.map(({ id, name, dropped }) => (
        <li key={id} className="held__note">
          {words.nodeDropped(name, dropped)}
        </li>
      ))}
    </ul>
  );
}
