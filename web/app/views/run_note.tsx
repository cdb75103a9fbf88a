import { IconAlertTriangle } from '@tabler/icons-react';
import { useEffect } from 'react';
import { countsOf } from '../../core/findings';
import { update } from '../../core/window_state';
import type { Doc } from '../../protocol/messages';
import { usePart, useStudio, useWindow } from '../hooks';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { text } from '../text';

/** What F5, pressed in this document, could not run, and what still runs. Lies over the document: nothing moves. */
export function RunNote({ doc }: { doc: Doc }) {
  const { window: store, registry } = useStudio();
  const note = useWindow((state) => state.runNote);
  // The node is loaded, or the plan can be started now: it says nothing of that any more.
  const isOver = usePart(
    'findings',
    {},
    (is) => !note?.about.some((one) => countsOf(is?.findings ?? [], one).errors > 0),
  );
  const isMine = note?.doc === doc;
  useEffect(() => {
    if (isMine && isOver) update(store, (draft) => void (draft.runNote = null));
  }, [store, isMine, isOver]);
  if (!isMine || isOver) return null;
  const dismiss = () => update(store, (draft) => void (draft.runNote = null));
  return (
    <div className="notice runnote" role="alert">
      <IconAlertTriangle className="icon" size={14} stroke={kStroke} aria-hidden />
      <span className="runnote__text">{note.text}</span>
      <span className="grow" />
      <Button small keys="F4" onClick={() => registry.run('problem.next')}>
        {text.commands['problem.next']}
      </Button>
      <Button small kind="plain" onClick={dismiss}>
        {text.seen}
      </Button>
    </div>
  );
}
