// What a timeline shows of the run, or of a trace: lanes from the server, and the names of curves.

import { useEffect, useMemo, useState, useSyncExternalStore } from 'react';
import { LanesFeed } from '../../../core/lanes';
import { kPlanNode, placeOf, pickName } from '../../../core/picks';
import type { Span } from '../../../core/ring';
import { newestSpan } from '../../../core/timeline';
import { useChanges, useStudio, useTopic } from '../../hooks';
import { useTraceName, useTraceOpen } from '../../past_hooks';
import { useVariablesOf } from '../../robot_hooks';
import type { CurveName } from './rows';
import { useTimelineView, viewOf } from './view_store';

/** As many curves as the server gives. */
const kCurvesMax = 16;

export function useLanes(shown: boolean, width: number) {
  const studio = useStudio();
  const [feed] = useState(
    () => new LanesFeed(studio.connection, (ms, act) => studio.world.later(ms, act)),
  );
  const curves = useCurves();
  const chosen = useTimelineView((view) => view.span);
  const history = useTopic('history', {});
  const trace = useTraceName();
  const robot = useTraceOpen()?.robot;
  const from = history?.from ?? 0;
  const to = history?.to ?? 0;
  const run = history?.run ?? 0;
  const words = JSON.stringify(curves.map(({ node, address }) => [node, address]));
  const known = trace !== null || (history !== undefined && history.kind !== 'none');
  const ready = shown && width > 1 && known;
  useEffect(() => {
    const span = chosen ?? newestSpan(from, to);
    const wish = {
      from: span.from,
      to: span.to,
      width: Math.max(1, Math.min(4000, Math.round(width))),
      words: JSON.parse(words) as number[][],
      ...(trace === null ? {} : { trace }),
      ...(robot === undefined ? {} : { robot }),
    };
    // What is over does not change; what goes on does while it is in sight.
    const until = trace === null ? Math.min(to, span.to) : 0;
    feed.want(ready ? wish : null, `${run} ${until}`);
  }, [feed, ready, chosen, width, words, trace, robot, run, from, to]);
  const lanes = useSyncExternalStore(
    useMemo(() => (listener: () => void) => feed.changed.on(listener), [feed]),
    () => feed.lanes,
  );
  const span: Span = chosen ?? feed.span ?? newestSpan(from, to);
  useEffect(() => viewOf(studio).setState({ drawn: span }));
  return { known, lanes: ready ? lanes : null, answered: feed.span ?? span, span, curves };
}

/** The variables of the plots, as words of nodes. */
function useCurves(): readonly CurveName[] {
  const { plotter } = useStudio();
  useChanges(plotter.changed);
  const picks = plotter.state.curves.flatMap(({ source }) =>
    source.is === 'word' && source.pick.node !== kPlanNode ? [source.pick] : [],
  );
  const nodes = [...new Set(picks.map(({ node }) => node))];
  const described = useVariablesOf(nodes);
  const robot = useTopic('robot', {});
  return picks.slice(0, kCurvesMax).flatMap((pick): CurveName[] => {
    const place = placeOf(pick, described.get(pick.node) ?? []);
    if (!place) return [];
    const node = robot?.nodes.find(({ id }) => id === pick.node)?.name ?? String(pick.node);
    const unit = place.variable.unit;
    const note = unit ? `${node} · ${unit}` : node;
    return [{ node: pick.node, address: place.first, name: pickName(pick), note }];
  });
}
