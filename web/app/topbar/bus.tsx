import type { Node } from '../../protocol/messages';
import { useStudio, useTopic } from '../hooks';
import { tipOf } from '../parts/button';
import { useNodeWord } from '../robot_hooks';
import { text } from '../text';

const kBarsMax = 12;

/** A bar for each node, how loaded the bus is, what was lost. A paused node is a red disc. */
export function Bus() {
  const { registry } = useStudio();
  const robot = useTopic('robot', {});
  const wordOf = useNodeWord();
  if (!robot || robot.kind === 'none') return null;
  const { nodes, load, lost } = robot;
  const summary =
    nodes.length > kBarsMax
      ? counted(nodes, wordOf)
      : nodes.map(({ name, state }) => `${name} ${wordOf(state)}`).join(', ');
  // Of many nodes those are shown first that do not run: they are what one looks for.
  const shown =
    nodes.length > kBarsMax
      ? [...nodes]
          .sort((a, b) => Number(a.state === 'running') - Number(b.state === 'running'))
          .slice(0, kBarsMax)
      : nodes;
  return (
    <button
      type="button"
      className="bus"
      onClick={() => registry.run('panel.network')}
      {...tipOf(summary || text.target.bus)}
    >
      <span className="hidden-text">
        {text.target.bus}: {summary}
      </span>
      <span className="bus__nodes" aria-hidden>
        {shown.map((node) => (
          <span key={node.id} className={`bus__node bus__node--${node.state}`} />
        ))}
      </span>
      <span className="bus__count">
        <b className="num">{nodes.length}</b> {text.target.nodes(nodes.length)}
      </span>
      {load === undefined ? null : (
        <span className="bus__load">
          {text.target.load} <b className="num">{load.toFixed(1)} %</b>
        </span>
      )}
      <span className={lost > 0 ? 'is-lossy' : 'bus__whole'}>
        {text.target.lostFrames} <b className="num">{lost}</b>
      </span>
    </button>
  );
}

/** "97 running, 3 paused": of many nodes only how many are in which state. */
function counted(nodes: readonly Node[], wordOf: (state: Node['state']) => string): string {
  const counts = new Map<Node['state'], number>();
  for (const { state } of nodes) counts.set(state, (counts.get(state) ?? 0) + 1);
  return [...counts].map(([state, count]) => text.target.nodesIn(count, wordOf(state))).join(', ');
}
