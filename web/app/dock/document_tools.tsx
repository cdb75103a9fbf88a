import {
  IconArrowBackUp,
  IconArrowForwardUp,
  IconBinary,
  IconDeviceFloppy,
  IconPlayerPause,
  IconPlayerPlay,
  IconPlayerSkipForward,
  IconPlayerStop,
  IconRefresh,
  IconUpload,
} from '@tabler/icons-react';
import type { Doc } from '../../protocol/messages';
import { update } from '../../core/window_state';
import { useDrives, useStudio, useTopic, useWindow } from '../hooks';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { useMayAct } from '../past_hooks';
import { text } from '../text';
import { keysShown } from '../parts/keys_shown';

/** At the right of the documents' tabs: what can be done with the node of the script. */
export function DocumentTools({ doc }: { doc: Doc }) {
  const { registry, window: store } = useStudio();
  const node = useTopic('robot', {})?.nodes.find((one) => one.doc === doc);
  const drives = useDrives();
  const mayAct = useMayAct();
  const listing = useWindow((state) => state.listing[doc] ?? false);
  if (!doc.includes('#')) return null;
  const runs = node?.state === 'running';
  // The commands are about the script that is looked at: this one, once its tools are used.
  const run = (id: string) => {
    update(store, (draft) => void (draft.doc = doc));
    registry.run(id);
  };
  const isHere = node !== undefined && node.state !== 'gone';
  const off = !mayAct || !isHere;
  return (
    <div className="doctools">
      <Button
        kind="plain"
        small
        className="byfinger"
        disabled={!drives}
        tip={text.commands['edit.undo']}
        icon={<IconArrowBackUp size={14} stroke={kStroke} />}
        onClick={() => run('edit.undo')}
      />
      <Button
        kind="plain"
        small
        className="byfinger"
        disabled={!drives}
        tip={text.commands['edit.redo']}
        icon={<IconArrowForwardUp size={14} stroke={kStroke} />}
        onClick={() => run('edit.redo')}
      />
      <Button
        kind="plain"
        small
        tip={text.commands['listing.toggle']}
        icon={<IconBinary size={14} stroke={kStroke} />}
        aria-pressed={listing}
        className={listing ? 'is-on' : ''}
        onClick={() => run('listing.toggle')}
      />
      <Button
        kind="plain"
        small
        disabled={off}
        tip={runs ? text.commands['node.pause'] : text.commands['node.run']}
        icon={
          runs ? (
            <IconPlayerPause size={14} stroke={kStroke} />
          ) : (
            <IconPlayerPlay size={14} stroke={kStroke} />
          )
        }
        onClick={() => run(runs ? 'node.pause' : 'node.run')}
      />
      <Button
        kind="plain"
        small
        disabled={off || node.state !== 'paused'}
        tip={text.commands['node.step']}
        icon={<IconPlayerSkipForward size={14} stroke={kStroke} />}
        onClick={() => run('node.step')}
      />
      <Button
        kind="plain"
        small
        disabled={!drives || !isHere || node.state === 'stopped'}
        tip={text.commands['node.stop']}
        icon={<IconPlayerStop size={14} stroke={kStroke} />}
        onClick={() => run('node.stop')}
      />
      <Button
        kind="plain"
        small
        disabled={off}
        tip={text.commands['node.reset']}
        icon={<IconRefresh size={14} stroke={kStroke} />}
        onClick={() => run('node.reset')}
      />
      <Button
        kind="plain"
        small
        disabled={off}
        tip={`${text.commands['node.load']}  (${keysShown('Alt+Shift+U')})`}
        icon={<IconUpload size={14} stroke={kStroke} />}
        onClick={() => run('node.load')}
        aria-label={text.editor.upload}
      >
        <span className="doctools__word">{text.editor.upload}</span>
      </Button>
      <Button
        kind="plain"
        small
        disabled={off}
        tip={text.editor.keepHelp}
        icon={<IconDeviceFloppy size={14} stroke={kStroke} />}
        onClick={() => run('node.save')}
        aria-label={text.editor.keep}
      >
        <span className="doctools__word">{text.editor.keep}</span>
      </Button>
    </div>
  );
}
