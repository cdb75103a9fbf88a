import { useState, type ReactNode } from 'react';
import type { Doc } from '../../../protocol/messages';
import { usePart, useTopic, useWindow } from '../../hooks';
import { ModeSwitch, type WorldMode } from './mode_switch';

/** In which of its modes the document of a world is shown, and what chooses another one. */
export function useMode(doc: Doc): {
  mode: WorldMode;
  choose(mode: WorldMode): void;
  modes: ReactNode;
} {
  const [chosen, choose] = useState<WorldMode | null>(null);
  const [byHand, setByHand] = useState(false);
  const isOurs = useTopic('studio', {})?.project?.world === doc;
  const state = usePart('clock', {}, (is) => is?.state);
  const [first] = useState<WorldMode>(() =>
    isOurs && (state === 'running' || state === 'paused') ? 'live' : 'edit',
  );
  const reveal = useWindow((window) => window.reveal);
  const [asked, setAsked] = useState<typeof reveal>(null);
  if (reveal !== asked) {
    setAsked(reveal);
    // A place in the text is asked for: a finding, something searched.
    if (reveal?.what === 'doc' && reveal.doc === doc && reveal.at) {
      setByHand(false);
      choose('text');
    }
  }
  const mode = chosen ?? first;
  const chooseByHand = (next: WorldMode) => {
    setByHand(true);
    choose(next);
  };
  return {
    mode,
    choose,
    modes: <ModeSwitch mode={mode} takesFocus={byHand} onChange={chooseByHand} />,
  };
}
