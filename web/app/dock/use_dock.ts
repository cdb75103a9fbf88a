// The life of the panels' model: made when a layout is chosen, kept when it changes, fitted to the
// window, and asked to show what someone wants to see.

import {
  Actions,
  DockLocation,
  TabNode,
  TabSetNode,
  type Action,
  type Model,
  type Node,
} from 'flexlayout-react';
import { useCallback, useEffect, useLayoutEffect, useRef, useState, type RefObject } from 'react';
import type { Doc, Json, Topics } from '../../protocol/messages';
import {
  filled,
  layoutPlans,
  smallPlans,
  tallPlan,
  type DocumentKind,
  type LayoutName,
  type Split,
} from '../../core/layouts';
import type { Studio } from '../../core/studio';
import { update, type Reveal } from '../../core/window_state';
import { keepState } from '../commands/looks';
import { usePart, useStudio, useWindow } from '../hooks';
import { takeFocus } from '../parts/take_focus';
import { panelOf } from './panels';
import { carryDocuments, type Opened } from './carry';
import { usePausedPlan } from './use_paused_plan';
import { useWindowForm, type WindowForm } from './use_window_form';
import {
  areaFor,
  areaForPanel,
  growArea,
  documentTab,
  documentTabs,
  fitModel,
  keptModel,
  lacksArea,
  makeModel,
  panelTab,
  type Extent,
} from './model';
import { documentExists, documentsOf, kindOf, tabNameOf } from '../documents';

/** What was dragged is kept so long after the last change. */
const kKeepMs = 800;

export function useDock(frameRef: RefObject<HTMLDivElement | null>): {
  model: Model | null;
  changed: (model: Model, action: Action) => void;
} {
  const studio = useStudio();
  const layout = useWindow((state) => state.layout);
  const nonce = useWindow((state) => state.layoutNonce);
  const scripts = usePart('scripts', {}, hasCome);
  const state = usePart('state', {}, hasCome);
  const files = usePart('files', {}, hasCome);
  const ready = scripts && state && files;
  const form = useWindowForm();
  const lacking = usePart('studio', {}, lackingIn);
  // The other layouts are places of work: what is missing is made there.
  const lacks = layout === 'Present' ? lacking : '';
  const key = keyOf(layout, form) + lacks;
  const [made, setMade] = useState<{ model: Model; key: string } | null>(null);
  const extent = useRef<Extent>({ width: 0, height: 0 });
  const before = useRef<Opened | null>(null);
  const closed = useRef(new Set<Doc>());
  const [keys] = useState(() => new WeakMap<Model, string>());

  useLayoutEffect(() => {
    if (!ready || !frameRef.current) return;
    // Another one has just been chosen: of this one nothing is opened that would stay.
    if (studio.window.getState().layout !== layout) return;
    const { clientWidth: width, clientHeight: height } = frameRef.current;
    extent.current = { width, height };
    const plan = planOf(layout, form, lacks);
    const next = openLayout(studio, { plan, key }, nonce > 0, extent.current);
    const opened = { model: next, plan };
    if (before.current) carryDocuments(studio, before.current, opened, closed.current);
    noteFirst(studio, next);
    if (mayTakeFocus(studio)) keepFocus(studio, next);
    before.current = opened;
    keys.set(next, key);
    setMade({ model: next, key });
  }, [studio, layout, form, lacks, key, keys, nonce, ready, frameRef]);

  const model = made?.model ?? null;
  useFit(frameRef, model, extent);
  // What is to be shown waits for the model of a layout that was just chosen.
  useReveal(studio, made?.key === key ? made.model : null);
  usePausedPlan(model);
  useNames(studio, model);
  const keep = useKeep(studio, keys);
  const changed = useCallback(
    (changedModel: Model, action: Action) => {
      noteClosed(closed.current, action);
      if (action.type === Actions.SELECT_TAB) growTiny(changedModel, action.data['tabNode']);
      keep(changedModel, action);
    },
    [keep],
  );
  return { model, changed };
}

type Lacks = '' | '-plan' | '-world' | '-plan-world';

function lackingIn(studio: Topics['studio']['is'] | undefined): Lacks {
  const plan = studio?.project?.plan === undefined ? '-plan' : '';
  const world = studio?.project?.world === undefined ? '-world' : '';
  return `${plan}${world}`;
}

function planOf(layout: LayoutName, form: WindowForm, lacks: Lacks): Split {
  const small = smallPlans[layout];
  const plan = { large: layoutPlans[layout], small, tall: tallPlan(small) }[form];
  if (lacks === '') return plan;
  return filled(plan, { plan: !lacks.includes('-plan'), world: !lacks.includes('-world') });
}

/** What a layout is kept under; that of a small window beside the other one. */
function keyOf(layout: LayoutName, form: WindowForm): string {
  return form === 'large' ? `layout.${layout}` : `layout.${form}.${layout}`;
}

function noteClosed(closed: Set<Doc>, { type, data }: Action): void {
  if (type === Actions.DELETE_TAB) closed.add(docOf(data['node']));
  if (type === Actions.ADD_TAB) closed.delete(docOf((data['json'] as { id?: unknown }).id));
}

function docOf(tab: unknown): Doc {
  return String(tab).replace(/^doc:/, '');
}

function hasCome(value: unknown): boolean {
  return value !== undefined;
}

function openLayout(
  studio: Studio,
  { plan, key }: { plan: Split; key: string },
  fresh: boolean,
  extent: Extent,
): Model {
  const values = studio.topics.get('state', {})?.values;
  const kept = isTable(values) ? values[key] : undefined;
  const known =
    !fresh && isTable(kept) ? keptModel(kept['model'], (doc) => documentExists(studio, doc)) : null;
  const docs = (kind: DocumentKind) =>
    documentsOf(studio, kind).map((doc) => ({ doc, name: tabNameOf(studio, doc) }));
  if (known && isTable(kept) && !lacksArea(known, plan, docs)) {
    fitModel(known, { width: Number(kept['width']), height: Number(kept['height']) }, extent);
    return known;
  }
  return makeModel(plan, extent, docs);
}

function useFit(
  frame: RefObject<HTMLDivElement | null>,
  model: Model | null,
  extent: RefObject<Extent>,
): void {
  useEffect(() => {
    if (!frame.current || !model) return;
    const observer = new ResizeObserver(([entry]) => {
      if (!entry) return;
      const { width, height } = entry.contentRect;
      const before = extent.current;
      if (width === 0 || (width === before.width && height === before.height)) return;
      extent.current = { width, height };
      fitModel(model, before, { width, height });
    });
    observer.observe(frame.current);
    return () => observer.disconnect();
  }, [frame, model, extent]);
}

/**
 * Tells which document is looked at, and keeps the layout a moment after the last change, or when the
 * page goes. The model of the layout before may still change: each is kept under its own key.
 */
function useKeep(
  studio: Studio,
  keys: WeakMap<Model, string>,
): (model: Model, action: Action) => void {
  const cancel = useRef<(() => void) | null>(null);
  const waiting = useRef<(() => void) | null>(null);
  const last = useRef<Model | null>(null);
  useEffect(() => {
    const leaves = () => waiting.current?.();
    addEventListener('pagehide', leaves);
    return () => removeEventListener('pagehide', leaves);
  }, []);
  return useCallback(
    (model, action) => {
      noteShown(studio, model);
      const key = keys.get(model);
      if (action.type === Actions.SET_ACTIVE_TABSET || key === undefined) return;
      if (last.current !== model) waiting.current?.();
      last.current = model;
      const put = () => {
        waiting.current = null;
        const rect = model.getRootRow()?.getRect();
        const value = {
          model: model.toJson() as unknown as Json,
          width: rect?.width ?? 0,
          height: rect?.height ?? 0,
        };
        keepState(studio, key, value);
      };
      cancel.current?.();
      cancel.current = studio.world.later(kKeepMs, put);
      waiting.current = put;
    },
    [studio, keys],
  );
}

export function noteShown(studio: Studio, model: Model): void {
  const shown = model.getActiveTabset()?.getSelectedNode();
  const doc = shown?.getId().startsWith('doc:') ? shown.getId().slice(4) : null;
  if (doc !== null) update(studio.window, (draft) => void (draft.doc = doc));
}

/**
 * Before anything was clicked F5 and the keyboard are for what the window opens with, a plan first; so they are in
 * another layout, where what was looked at is behind something else.
 */
function noteFirst(studio: Studio, model: Model): void {
  const shown = documentTabs(model).filter(([id]) => shows(model.getNodeById(id)?.getParent(), id));
  const { doc: last } = studio.window.getState();
  if (shown.some(([, doc]) => doc === last)) return;
  const [, first] = shown.find(([, doc]) => kindOf(doc) === 'plan') ?? shown[0] ?? [];
  if (first !== undefined) update(studio.window, (draft) => void (draft.doc = first));
}

function useReveal(studio: Studio, model: Model | null): void {
  const reveal = useWindow((state) => state.reveal);
  useEffect(() => {
    if (!model || !reveal) return;
    show(studio, model, reveal);
    // A document's place is shown by its editor, which then forgets it.
    if (reveal.what === 'panel' || reveal.at === null)
      update(studio.window, (draft) => void (draft.reveal = null));
  }, [studio, model, reveal]);
}

/** A file has another name: its tab follows, at its place. */
function useNames(studio: Studio, model: Model | null): void {
  useEffect(() => {
    if (!model) return;
    return studio.documents.moved.on(({ from, to }) => {
      const tab = model.getNodeById(`doc:${from}`);
      const area = tab?.getParent();
      if (!(tab instanceof TabNode) || !(area instanceof TabSetNode)) return;
      const index = area.getChildren().indexOf(tab);
      const isShown = area.getSelectedNode() === tab;
      if (!model.getNodeById(`doc:${to}`))
        model.doAction(
          Actions.addTab(
            documentTab(to, tabNameOf(studio, to)),
            area.getId(),
            DockLocation.CENTER,
            index,
            isShown,
          ),
        );
      model.doAction(Actions.deleteTab(tab.getId()));
      noteShown(studio, model);
    });
  }, [studio, model]);
}

function show(studio: Studio, model: Model, reveal: Reveal): void {
  const id = reveal.what === 'panel' ? `panel:${reveal.panel}` : `doc:${reveal.doc}`;
  const there = model.getNodeById(id);
  if (reveal.what === 'panel' && !reveal.focus) {
    if (hidesDocument(there ? there.getParent() : areaForPanel(model, reveal.panel))) return;
    if (reveal.over && !shows(there?.getParent(), `panel:${reveal.over}`)) return;
  }
  if (there instanceof TabNode && !(reveal.what === 'doc' && reveal.beside))
    model.doAction(Actions.selectTab(id));
  else if (reveal.what === 'panel') addPanel(model, reveal.panel);
  else {
    if (there) model.doAction(Actions.deleteTab(id));
    add(
      model,
      documentTab(reveal.doc, tabNameOf(studio, reveal.doc)),
      kindOf(reveal.doc),
      reveal.beside,
    );
  }
  if (reveal.what === 'panel' && (panelOf(reveal.panel)?.least ?? 0) > 0)
    growArea(model, id, panelOf(reveal.panel)?.least ?? 0);
  if (reveal.focus && (reveal.what === 'panel' || reveal.at === null)) focusTab(id);
  noteShown(studio, model);
}

/** Pixels: the tab, and two rows. */
const kTiny = 110;

/** A panel that somebody wants to see, and of which there is hardly more than its tab. */
function growTiny(model: Model, tab: unknown): void {
  const id = String(tab);
  const least = panelOf(id.replace(/^panel:/, ''))?.least ?? 0;
  const area = model.getNodeById(id)?.getParent();
  if (area instanceof TabSetNode && area.getRect().height < Math.min(kTiny, least))
    growArea(model, id, least);
}

/** A panel that shares its area with documents: one that shows itself must not cover what is worked on. */
function hidesDocument(area: Node | undefined): boolean {
  return area instanceof TabSetNode && area.getSelectedNode()?.getId().startsWith('doc:') === true;
}

const shows = (area: Node | undefined, tab: string): boolean =>
  area instanceof TabSetNode && area.getSelectedNode()?.getId() === tab;

function add(
  model: Model,
  tab: ReturnType<typeof panelTab>,
  kind: DocumentKind,
  beside: boolean,
): void {
  const area = areaFor(model, kind);
  if (area)
    model.doAction(
      Actions.addTab(
        tab,
        area.getId(),
        beside ? DockLocation.RIGHT : DockLocation.CENTER,
        -1,
        true,
      ),
    );
}

function addPanel(model: Model, id: string): void {
  const area = areaForPanel(model, id);
  if (area)
    model.doAction(Actions.addTab(panelTab(id), area.getId(), DockLocation.CENTER, -1, true));
}

/** What a tab is used for first: a text, which comes after its tools, as a drawing does. */
function firstIn(place: HTMLElement | null): HTMLElement | null {
  const meant = place?.querySelector<HTMLElement>('[data-autofocus]') ?? null;
  if (meant || !place || place.querySelector('.plan')) return meant;
  return place.querySelector<HTMLElement>(
    place.querySelector('.script__editor')
      ? '.cm-content'
      : 'select, button:not(:disabled), input, [tabindex="0"]',
  );
}

/** The tab's content may need a moment to be there. */
function focusTab(id: string): void {
  takeFocus(() => focusInTab(id));
}

function focusInTab(id: string): boolean {
  const place = document.querySelector<HTMLElement>(`[data-tab-content="${CSS.escape(id)}"]`);
  const target = firstIn(place);
  if (!target || target.offsetParent === null) return false;
  target.focus();
  return true;
}

/** Not in a page that was only loaded: the first key would be typed. A finger opens a project without keys on the screen. */
function mayTakeFocus({ window: store, wasOpenedHere }: Studio): boolean {
  const isTouched = matchMedia('(pointer: coarse)').matches;
  return store.getState().isLayoutChosen || (wasOpenedHere && !isTouched);
}

/** Another layout recreates its panels: the focus stays in the document, unless something else has it. */
function keepFocus(studio: Studio, model: Model): void {
  takeFocus(() => {
    if (document.activeElement !== document.body) return true;
    // The list of commands has given the keyboard back to what goes with the layout before.
    noteFirst(studio, model);
    const { doc } = studio.window.getState();
    return doc === null || focusInTab(`doc:${doc}`);
  });
}

function isTable(value: Json | undefined): value is Record<string, Json> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
