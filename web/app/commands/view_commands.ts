import type { Command } from '../../core/registry';
import type { Studio } from '../../core/studio';
import { layoutNames, type LayoutName } from '../../core/layouts';
import { readSettings, type Theme } from '../../core/settings';
import { revealDoc, revealPanel, showsFleet, update } from '../../core/window_state';
import { text } from '../text';
import { shownEditor } from './editor_handles';
import { focusRegion } from './focus';
import { drives, keepState, projectOf } from './looks';

const titles = text.commands;
const group = text.groups.view;
const themes: readonly Theme[] = ['system', 'dark', 'light'];

/** What there is to be shown. */
export interface Panel {
  id: string;
  title: string;
}

/** Panels, layouts, theme, palette, help. */
export function viewCommands(studio: Studio, panels: readonly Panel[]): Command[] {
  const palette = () =>
    update(
      studio.window,
      (draft) => void (draft.overlay = draft.overlay === 'palette' ? null : 'palette'),
    );
  const open = () => projectOf(studio) !== null;
  return [
    ...layoutNames.map((layout): Command => ({
      id: `layout.${layout}`,
      title: titles[`layout.${layout}`],
      group,
      enabled: open,
      run: () => chooseLayout(studio, layout),
    })),
    {
      id: 'layout.reset',
      title: titles['layout.reset'],
      group,
      enabled: open,
      run: () => resetLayout(studio),
    },
    {
      id: 'panel.next',
      title: titles['panel.next'],
      group,
      keys: ['F6'],
      run: () => focusRegion(1),
    },
    {
      id: 'panel.previous',
      title: titles['panel.previous'],
      group,
      keys: ['Shift+F6'],
      run: () => focusRegion(-1),
    },
    {
      id: 'fleet.show',
      title: titles['fleet.show'],
      group,
      enabled: () => (studio.topics.get('fleet', {})?.state ?? 'none') !== 'none',
      run() {
        const hasProject = projectOf(studio) !== null;
        update(
          studio.window,
          (draft) => void (draft.view = showsFleet(draft, hasProject) ? 'project' : 'fleet'),
        );
      },
    },
    { id: 'theme.next', title: titles['theme.next'], group, run: () => nextTheme(studio) },
    {
      id: 'access.renew',
      title: titles['access.renew'],
      group,
      enabled: () => drives(studio),
      run: () => update(studio.window, (draft) => void (draft.overlay = 'newToken')),
    },
    {
      id: 'settings.open',
      title: titles['settings.open'],
      group,
      keys: ['Ctrl+,'],
      enabled: open,
      run: () => revealPanel(studio.window, 'settings'),
    },
    {
      id: 'view.side',
      title: titles['view.side'],
      group,
      enabled: () => open() && studio.window.getState().doc !== null,
      run() {
        const { doc } = studio.window.getState();
        if (doc !== null) revealDoc(studio.window, doc, null, true, true);
      },
    },
    ...panels.map((panel): Command => ({
      id: `panel.${panel.id}`,
      title: text.panel(panel.title),
      group,
      enabled: open,
      run: () => revealPanel(studio.window, panel.id),
    })),
    {
      id: 'search.open',
      title: titles['search.open'],
      group: text.groups.edit,
      keys: ['Ctrl+Shift+F'],
      enabled: open,
      run: () => revealPanel(studio.window, 'search'),
    },
    {
      id: 'help.open',
      title: titles['help.open'],
      group: text.groups.help,
      keys: ['F1'],
      run: () => showHelp(studio, 'help'),
    },
    {
      id: 'help.keys',
      title: titles['help.keys'],
      group: text.groups.help,
      keys: ['?'],
      run: () => showHelp(studio, 'keys'),
    },
    {
      id: 'palette.open',
      title: titles['palette.open'],
      group: text.groups.help,
      keys: ['Ctrl+K', 'Ctrl+Shift+P'],
      hidden: true,
      run: palette,
    },
  ];
}

export function chooseLayout(studio: Studio, layout: LayoutName): void {
  update(studio.window, (draft) => {
    draft.layout = layout;
    draft.isLayoutChosen = true;
  });
  keepState(studio, 'layout', layout);
}

/** Opens it at the word where the caret is; the same key again closes it. */
function showHelp(studio: Studio, tab: 'help' | 'keys'): void {
  update(studio.window, (draft) => {
    const isShown = draft.overlay === 'help' && draft.help.tab === tab;
    draft.overlay = isShown ? null : 'help';
    draft.help = { tab, query: tab === 'help' ? (shownEditor(studio)?.word() ?? '') : '' };
  });
}

function resetLayout(studio: Studio): void {
  const { layout } = studio.window.getState();
  for (const form of ['', 'small.', 'tall.']) keepState(studio, `layout.${form}${layout}`, null);
  update(studio.window, (draft) => void draft.layoutNonce++);
}

function nextTheme(studio: Studio): void {
  const theme =
    studio.window.getState().theme ?? readSettings(studio.topics.get('studio', {})?.settings).theme;
  const next = themes[(themes.indexOf(theme) + 1) % themes.length] ?? 'system';
  update(studio.window, (draft) => void (draft.theme = next));
  if (drives(studio)) studio.order('settings.put', { key: 'theme', value: next });
}
