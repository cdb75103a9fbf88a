// What lives as long as the window: theme, keys, the layout that was chosen last.

import { useEffect, useEffectEvent, useLayoutEffect, useRef, useState } from 'react';
import { isLayoutName } from '../core/layouts';
import type { Theme } from '../core/settings';
import type { Studio } from '../core/studio';
import { revealPanel, toast, update } from '../core/window_state';
import { partOf } from '../core/paths';
import { countsOf } from '../core/findings';
import { text } from './text';
import { useLink, usePart, useSettings, useStudio, useTopic, useWindow } from './hooks';

const kThemeKey = 'vagus.theme';

export function useTheme(): 'dark' | 'light' {
  const settings = useSettings();
  const theme = useWindow((state) => state.theme) ?? settings.theme;
  const known = useTopic('studio', {}) !== undefined;
  const [system, setSystem] = useState(() => (lightSystem().matches ? 'light' : 'dark'));
  useEffect(() => {
    const query = lightSystem();
    const changed = () => setSystem(query.matches ? 'light' : 'dark');
    query.addEventListener('change', changed);
    return () => query.removeEventListener('change', changed);
  }, []);
  // Until the server has said what is set, the last theme of this browser is shown.
  const wanted: Theme = known ? theme : keptTheme();
  const shown = wanted === 'system' ? system : wanted;
  useEffect(() => {
    document.documentElement.dataset['theme'] = shown;
    if (known) localStorage.setItem(kThemeKey, theme);
  }, [shown, known, theme]);
  return shown === 'light' ? 'light' : 'dark';
}

export function keptTheme(): Theme {
  const kept = localStorage.getItem(kThemeKey);
  return kept === 'dark' || kept === 'light' ? kept : 'system';
}

function lightSystem(): MediaQueryList {
  return matchMedia('(prefers-color-scheme: light)');
}

export function useKeys(): void {
  const { registry } = useStudio();
  useEffect(() => {
    const pressed = (event: KeyboardEvent) => {
      if (event.defaultPrevented || event.isComposing) return;
      const { target } = event;
      const types = typesIn(target);
      // A field has its keys for itself, also one that is in a place: undo takes back what is typed.
      const isWithin = (place: string) =>
        !types && target instanceof Element && target.closest(`[data-place~="${place}"]`) !== null;
      if (registry.press(event, types, isWithin)) event.preventDefault();
    };
    addEventListener('keydown', leaveComposing, true);
    addEventListener('keydown', pressed);
    return () => {
      removeEventListener('keydown', leaveComposing, true);
      removeEventListener('keydown', pressed);
    };
  }, [registry]);
}

/**
 * While a word is being composed, its keys belong to the input method: Enter accepts the word without leaving
 * the field or submitting a form, and Escape cancels only the composition. The editor handles this itself.
 */
function leaveComposing(event: KeyboardEvent): void {
  if (!event.isComposing) return;
  if (event.target instanceof Element && event.target.closest('.cm-editor')) return;
  event.stopImmediatePropagation();
}

function typesIn(target: EventTarget | null): boolean {
  if (!(target instanceof HTMLElement)) return false;
  return (
    target.isContentEditable ||
    target.matches('input:not([type=checkbox], [type=radio]), textarea, select')
  );
}

/** Draws nothing: what it follows changes with each key, and the window is not drawn again for it. */
export function WindowLife(): null {
  const studio = useStudio();
  useAskForControl();
  useUnsentWork();
  useFirstLayout(studio);
  useLayoutName();
  useProblemsOpen();
  return null;
}

/** When a project is opened: the layout that was kept, unless a person was quicker and has chosen one. */
function useFirstLayout(studio: Studio): void {
  const values = useTopic('state', {})?.values;
  const folder = useTopic('studio', {})?.project?.folder;
  const hasPlan = useTopic('studio', {})?.project?.plan !== undefined;
  const known = values !== undefined;
  // Afterwards the window is ahead of what is kept.
  const open = useEffectEvent(() => {
    const layout =
      typeof values === 'object' && values !== null && !Array.isArray(values)
        ? values['layout']
        : undefined;
    const first = isLayoutName(layout) ? layout : hasPlan ? 'Draw' : null;
    if (first === null || studio.window.getState().isLayoutChosen) return;
    update(studio.window, (draft) => void (draft.layout = first));
  });
  useLayoutEffect(() => {
    if (known && folder !== undefined) open();
  }, [known, folder]);
}

/** What is not with the server is asked for before the page is left; what was refused is told. */
function useUnsentWork(): void {
  const studio = useStudio();
  useEffect(() => {
    const { documents } = studio;
    const leaves = (event: BeforeUnloadEvent) => {
      documents.fields.settle();
      if (documents.isUnsent || documents.hasLeft) event.preventDefault();
    };
    addEventListener('beforeunload', leaves);
    const ends = [
      documents.refused.on(({ doc, refusal }) =>
        toast(studio.window, 'error', text.documents.refused(doc, refusal)),
      ),
      studio.left.on(({ folder, docs }) =>
        toast(
          studio.window,
          'error',
          text.documents.left(folder, [...new Set(docs.map((doc) => partOf(doc).file))]),
        ),
      ),
    ];
    return () => {
      removeEventListener('beforeunload', leaves);
      ends.forEach((end) => end());
    };
  }, [studio]);
}

/** Letters are larger in a layout that is looked at from afar. */
function useLayoutName(): void {
  const layout = useWindow((state) => state.layout);
  useEffect(() => {
    document.documentElement.dataset['layout'] = layout;
  }, [layout]);
}

/**
 * A page that may drive takes control if no page has it, and when it opens as the only page: the server
 * keeps control a while for a page that was closed.
 */
function useAskForControl(): void {
  const studio = useStudio();
  const link = useLink();
  const driver = usePart('studio', {}, (is) => is?.driver);
  const clients = usePart('studio', {}, (is) => is?.clients);
  const opens = useRef(true);
  useEffect(() => {
    if (link.state !== 'open' || link.role !== 'drive' || driver === undefined) return;
    const isAlone = opens.current && clients === 1 && driver !== link.number;
    opens.current = false;
    if (driver === 0 || isAlone) studio.order('driver.ask', {});
  }, [studio, link, driver, clients]);
}

/** Problems opens by itself at the first error only, and not while a person looks back. */
function useProblemsOpen(): void {
  const studio = useStudio();
  const errors = usePart('findings', {}, (is) => countsOf(is?.findings ?? []).errors);
  const opened = useRef(false);
  useEffect(() => {
    // It would cover the timeline, which is needed to look back.
    if (errors === 0 || opened.current || studio.past.at !== null) return;
    opened.current = true;
    revealPanel(studio.window, 'problems', false);
  }, [studio, errors]);
}
