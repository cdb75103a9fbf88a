import { IconFolderOpen } from '@tabler/icons-react';
import { useStudio, useDrives } from '../hooks';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { text } from '../text';

export function FolderBox() {
  const { registry } = useStudio();
  const drives = useDrives();
  return (
    <section className="box" aria-label={text.start.folder}>
      <div className="first__title">
        <IconFolderOpen className="icon" size={16} stroke={kStroke} aria-hidden />
        <h2>{text.start.folder}</h2>
      </div>
      <div className="box__row">
        <span className="box__help">{text.start.folderHelp}</span>
        <Button disabled={!drives} keys="Ctrl+O" onClick={() => registry.run('folder.open')}>
          {text.start.open}
        </Button>
      </div>
      <div className="box__row">
        <span className="box__help">{text.start.newHelp}</span>
        <Button disabled={!drives} keys="Alt+N" onClick={() => registry.run('project.new')}>
          {text.start.new}
        </Button>
      </div>
    </section>
  );
}
