// What the window shows that is nobody else's business: layout, what is looked at, toasts. Changed
// by the functions below only.

import { createStore } from 'zustand/vanilla';
import type { Doc, NodeId, Place, Spot } from '../protocol/messages';
import { allEvents, type EventFilter } from './happenings';
import type { LayoutName } from './layouts';
import type { Theme } from './settings';

export const kToastsMax = 5;

export interface Toast {
  id: number;
  kind: 'note' | 'ok' | 'warning' | 'error';
  text: string;
}

/** Asks for a panel or a place in a document to be brought to the front. */
export type Reveal =
  | { nonce: number; what: 'panel'; panel: string; focus: boolean; over?: string }
  | { nonce: number; what: 'doc'; doc: Doc; at: Place | null; focus: boolean; beside: boolean };

export interface WindowState {
  layout: LayoutName;
  /** On this page, since the project was opened. */
  isLayoutChosen: boolean;
  /** Chosen on this page; what is set for the user counts where this is null. */
  theme: Theme | null;
  layoutNonce: number;
  doc: Doc | null;
  node: NodeId | null;
  cursor: Readonly<{ doc: Doc; line: number; column: number }> | null;
  overlay:
    'palette' | 'help' | 'folder' | 'project' | 'runFrom' | 'newTemplate' | 'newToken' | null;
  /** Which part of the help is shown first, and what is looked for there. */
  help: Readonly<{ tab: 'help' | 'keys'; query: string }>;
  /** A new file is being named in the tree, or a file renamed. */
  naming:
    | { kind: 'folder' | 'script' | 'plan' | 'world' | 'toolbox' | 'text' }
    | { rename: string }
    | null;
  reveal: Reveal | null;
  toasts: readonly Toast[];
  problem: number;
  listing: Readonly<Record<Doc, boolean>>;
  /** The plan from which a sub-plan was opened. */
  callers: Readonly<Record<Doc, Doc>>;
  /** A small form at a line of a script. */
  form: Readonly<{ doc: Doc; is: 'rename' | 'breakpoint'; line: number }> | null;
  references: Readonly<{ name: string; spots: readonly Spot[] }> | null;
  /** How the list of events is looked at. */
  events: Readonly<{
    filter: Readonly<EventFilter>;
    paused: boolean;
    counts: boolean;
    send: boolean;
  }>;
  /** The plot in numbers. */
  plotTable: boolean;
  /** What F5 could not run, said in the document where it was pressed. */
  runNote: Readonly<{ doc: Doc | null; text: string; about: readonly Doc[] }> | null;
  /** What fills the window where a fleet is open; null: the project, if there is one. */
  view: 'project' | 'fleet' | null;
  /** The menu of targets is open. */
  targets: boolean;
  /** Nodes that the buttons of the network are for; none: all. */
  chosenNodes: readonly NodeId[];
}

export type WindowStore = ReturnType<typeof createWindowStore>;

/** Whether an open fleet fills the window. */
export const showsFleet = ({ view }: Pick<WindowState, 'view'>, hasProject: boolean): boolean =>
  (view ?? (hasProject ? 'project' : 'fleet')) === 'fleet';

export function createWindowStore() {
  return createStore<WindowState>()(() => ({
    layout: 'Script',
    isLayoutChosen: false,
    theme: null,
    layoutNonce: 0,
    doc: null,
    node: null,
    cursor: null,
    overlay: null,
    help: { tab: 'help', query: '' },
    naming: null,
    reveal: null,
    toasts: [],
    problem: -1,
    listing: {},
    callers: {},
    form: null,
    references: null,
    events: { filter: allEvents, paused: false, counts: false, send: false },
    plotTable: false,
    runNote: null,
    view: null,
    targets: false,
    chosenNodes: [],
  }));
}

/** What belongs to a project goes with it; theme, toasts and an open palette stay. */
export function forgetProject(store: WindowStore): void {
  const { theme, toasts, overlay } = store.getState();
  store.setState({ ...store.getInitialState(), theme, toasts, overlay }, true);
}

let count = 0;

/** The draft is a copy whose members are replaced, never changed; listeners are told if one of them was. */
export function update(store: WindowStore, recipe: (draft: WindowState) => void): void {
  const before = store.getState();
  const draft = { ...before };
  recipe(draft);
  const names = Object.keys(draft) as (keyof WindowState)[];
  if (names.some((name) => !Object.is(draft[name], before[name]))) store.setState(draft, true);
}

export function updateEvents(store: WindowStore, part: Partial<WindowState['events']>): void {
  update(store, (draft) => void (draft.events = { ...draft.events, ...part }));
}

export function revealDoc(
  store: WindowStore,
  doc: Doc,
  at: Place | null,
  focus = true,
  beside = false,
): void {
  update(store, (draft) => {
    draft.doc = doc;
    draft.reveal = { nonce: ++count, what: 'doc', doc, at, focus, beside };
  });
}

/**
 * One that shows itself, without the keyboard, waits for nobody: a place that its editor has still to show goes first.
 * over: it comes only in place of that panel, where both are in one area.
 */
export function revealPanel(store: WindowStore, panel: string, focus = true, over?: string): void {
  update(store, (draft) => {
    if (!focus && draft.reveal?.what === 'doc' && draft.reveal.at !== null) return;
    draft.reveal = { nonce: ++count, what: 'panel', panel, focus, ...(over && { over }) };
  });
}

/** One that says the same as one that is there is not added again. */
export function toast(store: WindowStore, kind: Toast['kind'], text: string): void {
  update(store, (draft) => {
    const others = draft.toasts.filter((one) => one.text !== text);
    draft.toasts = [...others, { id: ++count, kind, text }].slice(-kToastsMax);
  });
}

export function dismiss(store: WindowStore, id: number): void {
  update(store, (draft) => {
    draft.toasts = draft.toasts.filter((one) => one.id !== id);
  });
}
