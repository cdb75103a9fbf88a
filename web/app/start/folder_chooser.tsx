import { IconArrowUp, IconX } from '@tabler/icons-react';
import { useEffect, useState } from 'react';
import type { Commands, FolderEntry } from '../../protocol/messages';
import { useStudio } from '../hooks';
import { OverlayFrame, useCloseOverlay } from '../parts/overlay_frame';
import { Quiet } from '../parts/blank';
import { Button } from '../parts/button';
import { FileIcon, kStroke } from '../parts/icons';
import { folderWords } from './words';

type Folder = Commands['folder.list']['out'];

/** Walks through the folders of the computer that runs the studio. */
export default function FolderChooser() {
  const studio = useStudio();
  const close = useCloseOverlay();
  const [path, setPath] = useState('');
  const [folder, setFolder] = useState<Folder | null>(null);
  useEffect(() => {
    let current = true;
    studio.send('folder.list', { path }).then(
      (found) => current && setFolder(found),
      (problem: unknown) => current && studio.tell(problem),
    );
    return () => void (current = false);
  }, [studio, path]);
  const open = (chosen: string) => {
    close();
    void studio.openAnother('project.open', { path: chosen });
  };
  const enter = (entry: FolderEntry) => {
    const inner = joined(folder?.path ?? '', entry.name);
    if (entry.kind === 'folder') setPath(inner);
    else open(inner);
  };
  return (
    <OverlayFrame label={folderWords.title}>
      <div className="palette">
        <form
          className="palette__search"
          onSubmit={(event) => (
            event.preventDefault(),
            setPath(new FormData(event.currentTarget).get('path') as string)
          )}
        >
          <Button
            kind="plain"
            tip={folderWords.up}
            disabled={!folder || folder.parent === folder.path}
            icon={<IconArrowUp size={16} stroke={kStroke} />}
            onClick={() => folder && setPath(folder.parent)}
          />
          <input
            name="path"
            aria-label={folderWords.path}
            key={folder?.path}
            defaultValue={folder?.path}
            spellCheck={false}
            className="mono"
          />
          <Button kind="primary" disabled={!folder} onClick={() => folder && open(folder.path)}>
            {folderWords.here}
          </Button>
          <Button
            kind="plain"
            tip={folderWords.close}
            icon={<IconX size={16} stroke={kStroke} />}
            onClick={close}
          />
        </form>
        <ul className="palette__list" aria-label={folderWords.path}>
          {folder?.entries.map((entry, index) => (
            <li key={entry.name}>
              <button
                type="button"
                className="row"
                autoFocus={index === 0}
                onClick={() => enter(entry)}
              >
                <FileIcon kind={entry.kind === 'recording' ? 'other' : entry.kind} />
                {entry.name}
              </button>
            </li>
          ))}
        </ul>
        {folder?.entries.length === 0 ? <Quiet>{folderWords.empty}</Quiet> : null}
      </div>
    </OverlayFrame>
  );
}

function joined(folder: string, name: string): string {
  return folder.endsWith('/') ? folder + name : `${folder}/${name}`;
}
