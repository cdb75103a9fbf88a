import { IconFolderOpen } from '@tabler/icons-react';
import { useStudio, useDrives } from '../hooks';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { startWords } from './words';

export function FolderBox() {
  const { registry } = useStudio();
  const drives = useDrives();
  return (
    <section className="box" aria-label={startWords.folder}>
      <div className="first__title">
        <IconFolderOpen className="icon" size={16} stroke={kStroke} aria-hidden />
        <h2>{startWords.folder}</h2>
      </div>
      <div className="box__row">
        <span className="box__help">{startWords.folderHelp}</span>
        <Button disabled={!drives} keys="Ctrl+O" onClick={() => registry.run('folder.open')}>
          {startWords.open}
        </Button>
      </div>
      <div className="box__row">
        <span className="box__help">{startWords.newHelp}</span>
        <Button disabled={!drives} keys="Alt+N" onClick={() => registry.run('project.new')}>
          {startWords.new}
        </Button>
      </div>
    </section>
  );
}
