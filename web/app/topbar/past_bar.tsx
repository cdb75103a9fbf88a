import { IconHistory } from '@tabler/icons-react';
import type { Topics } from '../../protocol/messages';
import { shownTime } from '../../core/numbers';
import { shownName } from '../../core/paths';
import { useLink, usePart } from '../hooks';
import { kStroke } from '../parts/icons';
import { Kbd } from '../parts/kbd';
import { useEnd, useIsPastShown, useTraceName } from '../past_hooks';
import { text } from '../text';
import { pastWords as words } from './past_words';
import '../look/timeline.css';

const size = { size: 14, stroke: kStroke };

/** What everything shows, and the way out. */
export default function PastBar({ at }: { at: number }) {
  const trace = useTraceName();
  const end = useEnd();
  const thinned = usePart('history', {}, (is) => is?.fine_from ?? 0) > at && trace === null;
  const runs = usePart('clock', {}, (is) => stateOf(is?.state));
  const ago = (end - at).toFixed(1);
  const isShown = useIsPastShown();
  const waits = useLink().state !== 'open' && !isShown;
  return (
    <div className="pastbar" role="region" aria-label={words.label} data-place="past">
      <IconHistory className="icon" {...size} aria-hidden />
      <b>{trace === null ? words.ago(ago) : words.trace(shownName(trace))}</b>
      <span className="ellipsis">
        {waits ? words.waits(shownTime(at)) : words.everything(shownTime(at))}{' '}
        {trace === null ? words.meanwhile[runs] : words.nothingRuns}
        {thinned ? ` ${words.thinned}` : ''}
      </span>
      <span className="grow" />
      {/* Said once when it begins, not at each step. */}
      <span className="hidden-text" role="status">
        {words.said}
      </span>
      <span>
        <Kbd keys="Esc" /> {trace === null ? text.past.escape : words.close}
      </span>
    </div>
  );
}

function stateOf(state: Topics['clock']['is']['state'] | undefined): 'runs' | 'paused' | 'over' {
  if (state === 'running') return 'runs';
  return state === 'paused' ? 'paused' : 'over';
}
