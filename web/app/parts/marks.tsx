import type { Node } from '../../protocol/messages';
import { text } from '../text';

export interface MarksState {
  saved: boolean;
  loaded: 'none' | 'older' | 'current';
  runs: 'none' | 'runs' | 'held';
}

/** The state of a script: saved, loaded, running. */
export function marksOf(unsaved: boolean, node: Node | undefined): MarksState {
  const loaded = node?.program === 'current' || node?.program === 'older' ? node.program : 'none';
  const runs = node?.state === 'running' ? 'runs' : node?.state === 'paused' ? 'held' : 'none';
  return { saved: !unsaved, loaded, runs: loaded === 'none' ? 'none' : runs };
}

/** The three marks of a tab: saved (square), on the robot (triangle up), runs (triangle right). */
export function Marks({ saved, loaded, runs }: MarksState) {
  const words = text.marks;
  const label = [
    saved ? words.saved : words.unsaved,
    { none: words.notLoaded, older: words.older, current: words.loaded }[loaded],
    { none: words.stopped, runs: words.runs, held: words.paused }[runs],
  ].join(', ');
  return (
    <span className="marks" role="img" aria-label={label} title={label}>
      <svg viewBox="0 0 8 8" className={saved ? 'is-set' : 'is-old'}>
        <path d="M1 1h6v6H1z" />
      </svg>
      <svg
        viewBox="0 0 8 8"
        className={{ none: 'is-none', older: 'is-old', current: 'is-set' }[loaded]}
      >
        <path d="M4 1L7.2 7H.8z" />
      </svg>
      <svg
        viewBox="0 0 8 8"
        className={{ none: 'is-none', runs: 'is-live', held: 'is-held' }[runs]}
      >
        <path d="M1 .8L7 4L1 7.2z" />
      </svg>
    </span>
  );
}

/** The square alone, for files that do not go to a robot. */
export function SavedMark({ saved }: { saved: boolean }) {
  const label = saved ? text.marks.saved : text.marks.unsaved;
  return (
    <span className="marks" role="img" aria-label={label} title={label}>
      <svg viewBox="0 0 8 8" className={saved ? 'is-set' : 'is-old'}>
        <path d="M1 1h6v6H1z" />
      </svg>
    </span>
  );
}
