import { IconHelpCircle } from '@tabler/icons-react';
import { memo } from 'react';
import type { Happening } from '../../../protocol/messages';
import { shownTime } from '../../../core/numbers';
import { askWhy } from '../../commands/ask_why';
import { useStudio } from '../../hooks';
import { kStroke } from '../../parts/icons';
import { text } from '../../text';
import { eventWords } from './words';

const kinds = eventWords.kindWords;

/** One line: when, who, what, with which arguments. What is no event says what it is. */
export const EventRow = memo(function EventRow({ item }: { item: Happening }) {
  const { kind, t, source, name, args } = item;
  return (
    <div className={`event event--${kind}`}>
      <time className="num" title={eventWords.timesHelp}>
        {shownTime(t)}
      </time>
      <span className="event__source ellipsis">{source}</span>
      {kind === 'event' ? (
        <code className="event__name ellipsis" title={`${name} [${args.join(', ')}]`}>
          {name} <span className="event__args">[{args.join(', ')}]</span>
        </code>
      ) : (
        <span className="event__what ellipsis" title={`${name} ${item.text}`}>
          <b className="event__kind">{kinds[kind]}</b> {name} {item.text}
        </span>
      )}
      {kind === 'event' ? <WhyButton name={name} /> : null}
    </div>
  );
});

function WhyButton({ name }: { name: string }) {
  const studio = useStudio();
  return (
    <button
      type="button"
      className="tool tool--later"
      tabIndex={-1}
      aria-label={text.why.row(name)}
      aria-keyshortcuts="W"
      title={`${text.why.row(name)}  (W)`}
      onClick={() => void askWhy(studio, 'event', name)}
    >
      <IconHelpCircle size={14} stroke={kStroke} aria-hidden />
    </button>
  );
}
