import type { Command } from '../../core/registry';
import type { Studio } from '../../core/studio';
import { revealPanel, update } from '../../core/window_state';
import { text } from '../text';
import { drives, mayLeave, projectOf } from './looks';

const titles = text.commands;
const group = text.groups.file;
const fileKinds = ['script', 'plan', 'world', 'toolbox', 'text', 'folder'] as const;

/** Projects and files. */
export function fileCommands(studio: Studio): Command[] {
  const may = () => drives(studio);
  const inProject = () => may() && projectOf(studio) !== null;
  const toAnother = () => mayLeave(studio);
  const shown = () => studio.window.getState().doc;
  const overlay = (name: 'folder' | 'project' | 'newTemplate') => () =>
    update(studio.window, (draft) => void (draft.overlay = name));
  return [
    {
      id: 'folder.open',
      title: titles['folder.open'],
      group,
      keys: ['Ctrl+O'],
      enabled: toAnother,
      run: overlay('folder'),
    },
    // Ctrl+N belongs to the browser.
    {
      id: 'project.new',
      title: titles['project.new'],
      group,
      keys: ['Alt+N'],
      enabled: toAnother,
      run: overlay('project'),
    },
    {
      id: 'project.make',
      title: titles['project.make'],
      group,
      enabled: () => toAnother() && projectOf(studio)?.bare === true,
      run() {
        // That there is no world is true no more.
        update(studio.window, (draft) => void (draft.toasts = []));
        return studio.openAnother('project.make', { doc: shown() ?? undefined });
      },
    },
    {
      id: 'template.new',
      title: titles['template.new'],
      group,
      enabled: inProject,
      run: overlay('newTemplate'),
    },
    {
      id: 'project.start',
      title: titles['project.start'],
      group,
      enabled: () => toAnother() && inProject(),
      async run() {
        await studio.documents.flushAll();
        await studio.send('project.close', {});
      },
    },
    {
      id: 'file.save',
      title: titles['file.save'],
      group,
      keys: ['Ctrl+S'],
      enabled: inProject,
      run: () => save(studio),
    },
    {
      id: 'file.saveAll',
      title: titles['file.saveAll'],
      group,
      keys: ['Ctrl+Shift+S'],
      enabled: inProject,
      run: () => saveAll(studio),
    },
    {
      id: 'file.revert',
      title: titles['file.revert'],
      group,
      enabled: () => inProject() && shown() !== null,
      async run() {
        const doc = shown() ?? '';
        await studio.change('doc.revert', { doc }, doc);
      },
    },
    ...fileKinds.map((kind): Command => ({
      id: `file.new.${kind}`,
      title: titles[`file.new.${kind}`],
      group,
      enabled: inProject,
      run() {
        revealPanel(studio.window, 'project', false);
        update(studio.window, (draft) => void (draft.naming = { kind }));
      },
    })),
    {
      id: 'file.export',
      title: titles['file.export'],
      group,
      enabled: () => projectOf(studio) !== null,
      // Loaded when it is first used: few ever export.
      run: async () => (await import('./export_zip')).exportZip(studio),
    },
  ];
}

async function saveAll(studio: Studio): Promise<void> {
  await studio.documents.flushAll();
  await studio.send('doc.save_all', {});
}

/** The document that is looked at; all if nobody has said which that is. */
async function save(studio: Studio): Promise<void> {
  const { doc } = studio.window.getState();
  if (doc === null) return saveAll(studio);
  await studio.documents.flushOne(doc);
  await studio.send('doc.save', { doc });
}
