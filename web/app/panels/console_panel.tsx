import { useEffect, useRef, useState } from 'react';
import type { Line } from '../../protocol/messages';
import { useStudio } from '../hooks';
import { Quiet } from '../parts/blank';
import { counted } from '../text';
import '../look/lists.css';

const kLinesMax = 1000;
const words = {
  label: 'Console',
  none: 'No output yet. Messages of the server, the run and the plan appear here.',
  leftOut: (count: number) => `${counted(count, 'line', 'lines')} left out`,
};

/** What the server, the run and the plan say; follows the newest while it is at the end. */
export default function ConsolePanel() {
  const { lines, leftOut } = useLines();
  const list = useRef<HTMLDivElement>(null);
  const follows = useRef(true);
  useEffect(() => {
    if (follows.current && list.current) list.current.scrollTop = list.current.scrollHeight;
  }, [lines]);
  if (lines.length === 0) return <Quiet>{words.none}</Quiet>;
  return (
    <div
      className="scroll console"
      role="log"
      aria-label={words.label}
      tabIndex={0}
      data-inset
      ref={list}
      onScroll={({ currentTarget: at }) =>
        (follows.current = at.scrollHeight - at.scrollTop - at.clientHeight < 24)
      }
    >
      {leftOut > 0 ? <Quiet>{words.leftOut(leftOut)}</Quiet> : null}
      {lines.map((line) => (
        <div key={line.number} className={`said said--${line.kind}`}>
          <time>{line.t.toFixed(3)}</time>
          <span>{line.text}</span>
        </div>
      ))}
    </div>
  );
}

function useLines(): { lines: Line[]; leftOut: number } {
  const { connection } = useStudio();
  const [state, setState] = useState<{ lines: Line[]; leftOut: number }>({ lines: [], leftOut: 0 });
  useEffect(() => {
    // Numbers are those of the server's life: it says its last lines again.
    const ends = [
      connection.renewed.on(() => setState({ lines: [], leftOut: 0 })),
      connection.watch(
        'console',
        { last: kLinesMax },
        {
          // The connection has checked each item against the topic.
          items: (items, left) =>
            setState((before) => ({
              lines: joined(before.lines, items as unknown as Line[]),
              leftOut: before.leftOut + left,
            })),
        },
      ),
    ];
    return () => ends.forEach((end) => end());
  }, [connection]);
  return state;
}

/** After a lost connection the last lines come again; each is shown once. */
function joined(before: Line[], items: Line[]): Line[] {
  const last = before.at(-1)?.number ?? -1;
  return [...before, ...items.filter((item) => item.number > last)].slice(-kLinesMax);
}
