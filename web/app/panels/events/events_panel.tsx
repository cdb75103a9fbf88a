import { useEffect, useMemo, useRef, useState } from 'react';
import type { Happening } from '../../../protocol/messages';
import { Filtered, passes } from '../../../core/happenings';
import { shortCount } from '../../../core/numbers';
import { askWhyEvent, isWhyKey } from '../../commands/ask_why';
import { useChanges, useStudio, useTopic, useWindow } from '../../hooks';
import { Quiet } from '../../parts/blank';
import { VirtualRows } from '../../parts/virtual_rows';
import { usePastEvents } from '../../past_hooks';
import { useShown } from '../../robot_hooks';
import { text } from '../../text';
import { EventBar } from './event_bar';
import { EventCounts } from './event_counts';
import { EventRow } from './event_row';
import { SendForm } from './send_form';
import { eventWords } from './words';
import '../../look/robot.css';

const words = eventWords;

/** Each event on the bus and what else happened, the newest first; and a form that sends one. */
export default function EventsPanel() {
  const frame = useRef<HTMLDivElement>(null);
  const shown = useShown(frame);
  const { send, counts } = useWindow((state) => state.events);
  return (
    <div className="events" ref={frame}>
      <EventBar />
      {send ? <SendForm /> : null}
      {shown ? counts ? <EventCounts /> : <EventList /> : null}
    </div>
  );
}

function EventList() {
  const studio = useStudio();
  const { happenings } = studio;
  useEffect(() => happenings.follow(), [happenings]);
  useChanges(happenings.changed);
  const { items, held } = useShownItems();
  const robot = useTopic('robot', {});
  return (
    <>
      {items.length === 0 ? (
        <Quiet>{happenings.items.length === 0 ? text.empty.events : words.nothing}</Quiet>
      ) : (
        <VirtualRows
          rows={items}
          label={words.label}
          keyOf={(item) => item.number}
          newestFirst
          className="events__list"
          onRowKey={(item, event) => {
            if (item.kind === 'event' && isWhyKey(event)) askWhyEvent(studio, item);
          }}
        >
          {(item) => <EventRow item={item} />}
        </VirtualRows>
      )}
      <footer className="events__foot num">
        <span title={words.timesHelp}>
          {words.shown(shortCount(items.length), shortCount(happenings.items.length))}{' '}
          {words.happened}
        </span>
        {robot && robot.kind !== 'none' ? (
          <span>
            {shortCount(robot.events_a_second)} {words.aSecond}
          </span>
        ) : null}
        {held > 0 ? <span className="is-warning">{words.heldMore(held)}</span> : null}
        <span className="grow" />
        {robot && robot.lost > 0 ? (
          <span className="is-warning">{words.lost(robot.lost)}</span>
        ) : null}
        {happenings.leftOut > 0 ? (
          <span className="is-warning" title={words.leftOutHelp}>
            {words.leftOut(happenings.leftOut)}
          </span>
        ) : null}
      </footer>
    </>
  );
}

/** What passes the filter, the newest first; held: what was there when it was held. */
function useShownItems(): { items: readonly Happening[]; held: number } {
  const { happenings } = useStudio();
  const { filter, paused } = useWindow((state) => state.events);
  const [filtered] = useState(() => new Filtered());
  const test = useMemo(() => passes(filter), [filter]);
  const then = usePastEvents();
  const [limit, setLimit] = useState(Infinity);
  if (paused !== (limit !== Infinity))
    setLimit(paused ? (happenings.items.at(-1)?.number ?? -1) : Infinity);
  const all = filtered.of(happenings.items, test);
  return useMemo(() => {
    if (then) return { items: then.filter(test).toReversed(), held: 0 };
    const seen = limit === Infinity ? all : all.filter((item) => item.number <= limit);
    return { items: seen.toReversed(), held: all.length - seen.length };
  }, [all, limit, then, test]);
}
