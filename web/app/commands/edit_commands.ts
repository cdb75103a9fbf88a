import type { Command } from '../../core/registry';
import type { Studio } from '../../core/studio';
import { update } from '../../core/window_state';
import { text } from '../text';
import { shownEditor, type EditorHandle } from './editor_handles';
import { drives } from './looks';

const titles = text.commands;
type EditId = Extract<keyof typeof titles, `edit.${string}` | `break.${string}`>;

/** For the script that is looked at. */
export function editCommands(studio: Studio): Command[] {
  const isScript = () => studio.window.getState().doc?.includes('#') ?? false;
  const open = () => shownEditor(studio) !== undefined;
  const make = (
    id: EditId,
    keys: string[],
    act: Exclude<keyof EditorHandle, 'word' | 'line' | 'mayUndo' | 'mayRedo'>,
    may: () => boolean,
  ): Command => ({
    id,
    title: titles[id],
    group: id === 'edit.definition' || id === 'edit.references' ? text.groups.go : text.groups.edit,
    keys,
    enabled: () => open() && may(),
    run: () => shownEditor(studio)?.[act](),
  });
  const changes = () => drives(studio);
  const script = () => isScript();
  const inScript = () => isScript() && drives(studio);
  return [
    make('edit.definition', ['F12'], 'definition', script),
    make('edit.references', ['Shift+F12'], 'references', script),
    // In the tree F2 renames the file; the tree takes the key first.
    make('edit.rename', ['F2'], 'rename', inScript),
    make('edit.complete', ['Ctrl+Space'], 'complete', script),
    make('edit.find', ['Ctrl+F'], 'find', () => true),
    make('edit.comment', ['Ctrl+/'], 'comment', changes),
    // Its keys are the editor's own. A keyboard on a screen has none of them.
    make('edit.undo', [], 'undo', () => changes() && (shownEditor(studio)?.mayUndo() ?? false)),
    make('edit.redo', [], 'redo', () => changes() && (shownEditor(studio)?.mayRedo() ?? false)),
    make('break.toggle', ['F9'], 'toggleBreakpoint', inScript),
    make('break.edit', ['Ctrl+F9'], 'editBreakpoint', inScript),
    {
      id: 'listing.toggle',
      title: titles['listing.toggle'],
      group: text.groups.view,
      keys: ['Alt+L'],
      enabled: isScript,
      run: () =>
        update(studio.window, (draft) => {
          const { doc, listing } = draft;
          if (doc !== null) draft.listing = { ...listing, [doc]: !(listing[doc] ?? false) };
        }),
    },
  ];
}
