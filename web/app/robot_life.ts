// What lives as long as the window: the watch table and the plot are kept with the project, and nodes
// that are paused keep the marks of what has changed.

import { useEffect, useRef } from 'react';
import type { Json } from '../protocol/messages';
import { picksJson, readPicks } from '../core/picks';
import { plotJson, readPlot } from '../core/plot';
import { toast } from '../core/window_state';
import { keepState } from './commands/looks';
import { usePart, useStudio, useTopic } from './hooks';
import { text } from './text';

/** What was picked is kept so long after the last change. */
const kKeepMs = 500;

/** Shows nothing. A component of its own, so that the clock does not render the whole window. */
export function RobotLife(): null {
  useKept();
  useStanding();
  useLostRun();
  return null;
}

/** The run ends with the server; what it did until then is kept. */
function useLostRun(): void {
  const studio = useStudio();
  useEffect(
    () =>
      studio.connection.renewed.on(() => {
        const isSimulated = studio.topics.get('history', {})?.kind === 'simulated';
        const { state, t } = studio.topics.get('clock', {}) ?? { state: 'none', t: 0 };
        if (isSimulated && (state === 'running' || state === 'paused') && t > 0)
          toast(studio.window, 'warning', text.run.lostRun);
      }),
    [studio],
  );
}

function useKept(): void {
  const studio = useStudio();
  const values = useTopic('state', {})?.values;
  const folder = useTopic('studio', {})?.project?.folder;
  const known = useRef<string | null>(null);
  const kept = useRef({ watch: '', plots: '' });
  useEffect(() => {
    if (values === undefined || folder === undefined || known.current === folder) return;
    known.current = folder;
    const table: Record<string, Json> =
      typeof values === 'object' && values !== null && !Array.isArray(values) ? values : {};
    studio.watched.set(readPicks(table['watch']));
    studio.plotter.set(readPlot(table['plots']));
    kept.current = texts(studio.watched.list, studio.plotter.state);
  }, [studio, values, folder]);
  useEffect(() => {
    let cancel = () => {};
    const keep = () => {
      cancel();
      cancel = studio.world.later(kKeepMs, () => {
        if (known.current === null) return;
        const now = texts(studio.watched.list, studio.plotter.state);
        if (now.watch !== kept.current.watch)
          keepState(studio, 'watch', picksJson(studio.watched.list));
        if (now.plots !== kept.current.plots)
          keepState(studio, 'plots', plotJson(studio.plotter.state));
        kept.current = now;
      });
    };
    const ends = [studio.watched.changed.on(keep), studio.plotter.changed.on(keep)];
    return () => (cancel(), ends.forEach((end) => end()));
  }, [studio]);
}

function texts(picks: Parameters<typeof picksJson>[0], plot: Parameters<typeof plotJson>[0]) {
  return { watch: JSON.stringify(picksJson(picks)), plots: JSON.stringify(plotJson(plot)) };
}

function useStanding(): void {
  const { words } = useStudio();
  const nodes = useTopic('robot', {})?.nodes;
  // A simulation whose clock is stopped holds all its nodes, whatever their own state is.
  const held = usePart('clock', {}, (is) => is?.state === 'paused');
  useEffect(() => {
    for (const node of nodes ?? []) words.pause(node.id, held || node.state === 'paused');
  }, [words, nodes, held]);
}
