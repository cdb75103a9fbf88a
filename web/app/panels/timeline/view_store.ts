// Which seconds a timeline shows: those that a person chose, or the newest.

import { useStore } from 'zustand';
import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Span } from '../../../core/ring';
import type { Studio } from '../../../core/studio';
import { wholeSpan, zoomedSpan } from '../../../core/timeline';
import { useStudio } from '../../hooks';

export interface TimelineView {
  /** null: the newest are followed. */
  span: Span | null;
  /** What is in sight, as it was drawn last. */
  drawn: Span;
  /** Held since a person looks back: then goes on with it. */
  held: boolean;
}

const stores = new WeakMap<Studio, StoreApi<TimelineView>>();

export function viewOf(studio: Studio): StoreApi<TimelineView> {
  const known = stores.get(studio);
  if (known) return known;
  const made = createStore<TimelineView>()(() => ({
    span: null,
    drawn: { from: 0, to: 30 },
    held: false,
  }));
  stores.set(studio, made);
  studio.past.changed.on(() => hold(studio, made));
  return made;
}

/** While somebody looks back, time does not carry the lanes away. */
function hold(studio: Studio, store: StoreApi<TimelineView>): void {
  const { span, drawn, held } = store.getState();
  const { past } = studio;
  if (past.trace && !held) return store.setState({ span: wholeOf(studio), held: true });
  if (past.at !== null && span === null) store.setState({ span: drawn, held: true });
  if (past.at === null && held) store.setState({ span: null, held: false });
}

const wholeOf = ({ past }: Studio): Span => wholeSpan(past.start, past.end);

export function showAll(studio: Studio): void {
  viewOf(studio).setState({ span: wholeOf(studio), held: false });
}

export function followNewest(studio: Studio): void {
  viewOf(studio).setState({ span: null, held: false });
}

/** Around the cursor if it is in sight, else around the middle. */
export function zoomBy(studio: Studio, factor: number, around?: number): void {
  const store = viewOf(studio);
  const { drawn } = store.getState();
  const { at } = studio.past;
  const middle = (drawn.from + drawn.to) / 2;
  const seen = at !== null && at >= drawn.from && at <= drawn.to ? at : middle;
  store.setState({ span: zoomedSpan(drawn, around ?? seen, factor), held: false });
}

export function useTimelineView<T>(select: (view: TimelineView) => T): T {
  return useStore(viewOf(useStudio()), select);
}
