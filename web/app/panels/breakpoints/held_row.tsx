import type { HeldEvent, Node } from '../../../protocol/messages';
import { shownTime } from '../../../core/numbers';
import { useStudio, useTopic, useDrives } from '../../hooks';
import { Button } from '../../parts/button';
import { heldWords } from './words';

const words = heldWords;

/** One event that waits: when it came, from whom, and what may be done with it. */
export function HeldRow({ one, nodes }: { one: HeldEvent; nodes: readonly Node[] }) {
  const studio = useStudio();
  const drives = useDrives();
  const stands = useTopic('held', {})?.stands ?? false;
  const { number, t, after, node, name, args } = one;
  const source = node === 0 ? words.host : (nodes.find(({ id }) => id === node)?.name ?? `${node}`);
  const said = args.length > 0 ? `${name} [${args.join(', ')}]` : name;
  const acts = [
    ['plan.held.go', words.go],
    ['plan.held.step', words.step],
    ['plan.held.drop', words.drop],
  ] as const;
  return (
    <li className="held">
      <time className="num">{shownTime(t)}</time>
      {after > 0 ? <span className="held__after num">{words.after(after)}</span> : null}
      <span className="held__source ellipsis">{source}</span>
      <code className="held__name ellipsis" title={said}>
        {said}
      </code>
      {acts.map(([command, word]) => (
        <Button
          key={command}
          small
          disabled={!drives || !stands}
          aria-label={`${word} ${said}`}
          onClick={() => studio.order(command, { number })}
        >
          {word}
        </Button>
      ))}
    </li>
  );
}
