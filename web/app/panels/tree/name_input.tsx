import { useEffect, useRef, useState } from 'react';
import type { FileEntry, Path } from '../../../protocol/messages';
import { badName, baseName, folderOf, joinPath } from '../../../core/paths';
import { revealDoc, update } from '../../../core/window_state';
import { documentsIn } from '../../documents';
import { useStudio } from '../../hooks';
import { FileIcon } from '../../parts/icons';
import { takeFocus } from '../../parts/take_focus';
import { text } from '../../text';

type NewKind = 'folder' | 'script' | 'plan' | 'world' | 'toolbox' | 'text';

const endings: Record<NewKind, string> = {
  folder: '',
  script: '.aesl',
  plan: '.plan.json',
  world: '.world.json',
  toolbox: '.toolbox.json',
  text: '.txt',
};

/** Names a new file, or renames one, where it is in the tree. */
export function NameInput({
  folder,
  kind,
  rename,
}: {
  folder: Path;
  kind: NewKind;
  rename?: Path;
}) {
  const studio = useStudio();
  const given = rename ? baseName(rename) : `new${endings[kind]}`;
  const [name, setName] = useState(given);
  const why = badName(name);
  const field = useRef<HTMLInputElement>(null);
  // The panel may be behind another tab until that tab is in front.
  useEffect(() => {
    takeFocus(() => {
      field.current?.focus();
      return !field.current || document.activeElement === field.current;
    });
  }, []);
  const ended = useRef(false);
  const end = () => {
    ended.current = true;
    update(studio.window, (draft) => void (draft.naming = null));
  };
  const done = async (takes: 'focus' | 'nothing') => {
    if (why) return;
    end();
    const path = joinPath(rename ? folderOf(rename) : folder, name);
    if (rename && path !== rename) await studio.change('file.rename', { path: rename, to: path });
    if (rename) return;
    await studio.send('file.new', { path, kind });
    if (kind === 'folder') return;
    // If the next file is being named already, its field keeps the focus.
    const free = takes === 'focus' && studio.window.getState().naming === null;
    revealDoc(studio.window, documentsIn(studio, path)[0] ?? path, null, free);
  };
  const tryDone = (takes: 'focus' | 'nothing') =>
    done(takes).catch((problem: unknown) => studio.tell(problem));
  // Who goes elsewhere keeps what was typed, if it is a name; a tablet may have no Enter at hand.
  const leave = () => {
    if (ended.current) return;
    if (name === given || why) end();
    else void tryDone('nothing');
  };
  return (
    <form
      className="tree__name"
      onSubmit={(event) => {
        event.preventDefault();
        void tryDone('focus');
      }}
    >
      <FileIcon kind={rename ? iconKind(rename) : kind} />
      <input
        className="field field--small field--ui"
        ref={field}
        aria-label={rename ? text.tree.rename : text.tree.newName}
        aria-invalid={why !== ''}
        title={why}
        value={name}
        spellCheck={false}
        onChange={(event) => setName(event.target.value)}
        onFocus={(event) => event.target.setSelectionRange(0, stem(event.target.value))}
        // A window that another one covers keeps its field.
        onBlur={(event) => document.activeElement !== event.target && leave()}
        onKeyDown={(event) => event.key === 'Escape' && (event.stopPropagation(), end())}
      />
    </form>
  );
}

/** The ending stays unless someone means it. */
function stem(name: string): number {
  const dot = name.indexOf('.');
  return dot > 0 ? dot : name.length;
}

function iconKind(path: Path): FileEntry['kind'] {
  if (path.endsWith('.aesl')) return 'script';
  return baseName(path).includes('.') ? 'text' : 'folder';
}
