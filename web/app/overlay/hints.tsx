import { countsOf } from '../../core/findings';
import { kindOf } from '../documents';
import { usePart, useWindow } from '../hooks';
import { Kbd } from '../parts/kbd';
import { usePastTime } from '../past_hooks';
import { text } from '../text';

const words = text.status.keys;
type Hint = readonly [keys: string, word: string];

/** Keys of the page of a fleet. */
export function FleetHints() {
  const hints: readonly Hint[] = [
    ['Space', words.choose],
    ['Enter', words.studio],
    ['F6', words.next],
    ['Ctrl+K', words.commands],
  ];
  return <HintList hints={hints} />;
}

/** The keys that help now. */
export function Hints({ started }: { started: boolean }) {
  const layout = useWindow((state) => state.layout);
  const doc = useWindow((state) => state.doc);
  const errors = usePart('findings', {}, (is) => countsOf(is?.findings ?? []).errors);
  const looksBack = usePastTime() !== null;
  const paused = usePart('clock', {}, (is) => is?.state === 'paused');
  const hints: Hint[] = [];
  if (!started)
    hints.push(
      ['Tab', words.tab],
      ['Enter', words.open],
      ['Ctrl+K', words.commands],
      ['F1', words.help],
    );
  else {
    if (looksBack) hints.push(['Esc', text.past.escape], ['←→', words.step20]);
    else if (paused) hints.push(['F5', words.continue], ['F10', words.step]);
    else if (errors > 0) hints.push(['Alt+Enter', words.fix]);
    if (doc !== null && kindOf(doc) === 'plan') hints.push(['F9', words.breakpoint]);
    if (doc?.includes('#')) hints.push(['F9', words.breakpoint], ['Alt+Shift+U', words.upload]);
    hints.push(['F6', words.next]);
    if (layout === 'Draw' || !doc?.includes('#'))
      hints.push(['Ctrl+K', words.commands], ['?', words.keys]);
  }
  return <HintList hints={hints} />;
}

function HintList({ hints }: { hints: readonly Hint[] }) {
  return (
    <span className="status__hints">
      {hints.map(([keys, word]) => (
        <span key={keys} className="status__part">
          <Kbd keys={keys} /> {word}
        </span>
      ))}
    </span>
  );
}
