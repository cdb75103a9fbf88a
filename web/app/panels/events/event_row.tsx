import { IconHelpCircle } from '@tabler/icons-react';
import { memo } from 'react';
import type { Happening } from '../../../protocol/messages';
import { shownTime } from '../../../core/numbers';
import { askWhyEvent } from '../../commands/ask_why';
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
      {kind === 'event' ? <WhyButton item={item} /> : null}
    </div>
  );
});

function WhyButton({ item }: { item: Happening }) {
  const studio = useStudio();
  const { name } = item;
  return (
    <button
      type="button"
      className="tool tool--later"
      tabIndex={-1}
      aria-label={text.why.row(name)}
      aria-keyshortcuts="W"
      title={`${text.why.row(name)}  (W)`}
      onClick={() => askWhyEvent(studio, item)}
    >
      <IconHelpCircle size={14} stroke={kStroke} aria-hidden />
    </button>
  );
}
